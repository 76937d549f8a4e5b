//! What a wheel does: whether it stands, is blocked, or rolls.

use core::ops::BitOrAssign;

use super::estimate::WheelActivity;
use super::since_start::SinceStart;
use super::slip_by_speeds::SpeedReadings;
use super::slip_torque::SlipTorqueFilter;
use crate::scalar::Scalar;

/// Below this speed of rim and hub a wheel stands, m/s.
pub const STANDING_M_S: f64 = 1.5e-3;
/// A wheel whose rim moves at less than this part of its hub's speed is blocked.
pub(super) const BLOCKED: f64 = 0.08;

/// What a wheel does, by the speeds of its rim and its hub, m/s, and by what it did before: one that is blocked turns again when its rim is
/// faster than the noise of an encoder makes it seem.
pub(super) fn what_it_does<S: Scalar>(rim: S, hub: S, before: WheelActivity) -> WheelActivity {
    let standing = S::constant(STANDING_M_S);
    let blocked = S::constant(BLOCKED) * hub.abs();
    let least = if before == WheelActivity::Blocked { (blocked + blocked).max(standing) } else { blocked };
    if rim.abs() < standing && hub.abs() < standing {
        WheelActivity::Standing
    } else if rim.abs() < least {
        WheelActivity::Blocked
    } else {
        WheelActivity::Rolling
    }
}

/// What comes of what a wheel does in a frame, or of what any of several do.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct TakenUp {
    /// It stands.
    pub stands: bool,
    /// It stands, or has just started.
    pub starts: bool,
    /// Its start is over in this frame.
    pub settles: bool,
}

impl BitOrAssign for TakenUp {
    fn bitor_assign(&mut self, other: Self) {
        self.stands |= other.stands;
        self.starts |= other.starts;
        self.settles |= other.settles;
    }
}

/// Begins what a wheel does now, where that is something else than `before`, in its filter, which is told as well how long it has rolled at
/// the end of a frame of so long, s; one that is blocked is told so in every frame.
pub(super) fn take_up<S: Scalar>(
    filter: &mut SlipTorqueFilter<S>,
    (before, since_start): (&mut WheelActivity, &mut SinceStart<S>),
    now: WheelActivity,
    speeds: &SpeedReadings<S>,
    step_s: S,
) -> TakenUp {
    if now == WheelActivity::Blocked {
        filter.block();
    } else if now != *before {
        filter.start(speeds);
    }
    *before = now;
    let stands = now == WheelActivity::Standing;
    let settles = since_start.follow(stands, step_s);
    let starts = since_start.starts();
    if starts {
        filter.unsettle(step_s);
    }
    if settles {
        filter.settle();
    }
    TakenUp { stands, starts, settles }
}

#[cfg(test)]
mod tests {
    use super::{WheelActivity, what_it_does};

    /// A wheel that is dragged at 20 mm/s is blocked while its rim moves at less than 1.6 mm/s, and then until it moves at 3.2; one that
    /// hardly moves at all, until its rim is faster than the 1.5 mm/s at which it would stand.
    #[test]
    fn a_blocked_wheel_is_blocked_until_its_rim_is_faster_than_noise() {
        let rolls = |rim: f64, hub: f64, before| what_it_does(rim, hub, before) == WheelActivity::Rolling;
        assert!(!rolls(0.0015, 0.02, WheelActivity::Rolling) && rolls(0.0017, 0.02, WheelActivity::Rolling));
        assert!(!rolls(-0.0031, 0.02, WheelActivity::Blocked) && rolls(0.0033, 0.02, WheelActivity::Blocked));
        assert!(!rolls(0.001, 0.003, WheelActivity::Blocked) && rolls(0.001, 0.003, WheelActivity::Standing));
        assert_eq!(what_it_does(0.001, 0.001, WheelActivity::Blocked), WheelActivity::Standing);
    }
}
