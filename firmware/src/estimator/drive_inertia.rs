//! What of a drive's torque its own inertia takes.
//!
//! Where a wheel speeds up or slows down, what its motor gives is not what the soil meets, and not what the link has to hold: J ω̇ stays
//! between motor and gear. Reflected through a gear that is much. At a steady rate it is nothing, and what a noisy torque differs by from the
//! resistive torque is no reason to take it for something.

use crate::scalar::Scalar;

/// Of what is new, the part that is taken in at once, and all of it beyond about so many standard deviations: rims change their speed from one
/// frame to the next.
const SHARE: f64 = 0.2;
const JUMPS: f64 = 4.0;
/// Less than so many standard deviations of the drive's torque is taken for nothing: nearly five of what noise makes of the mean.
const NOTHING: f64 = 1.6;
/// Over so many standard deviations about these bounds the one turns into the other: where it did at once, rounding would decide now and then
/// what a link has to hold.
const TURNS: f64 = 0.5;

/// The torque that goes into the inertia of one drive.
#[derive(Debug, Clone, Copy)]
pub(super) struct DriveInertia<S> {
    torque_nm: S,
    /// Whether it may be another in the next frame, whatever it was.
    may_jump: bool,
}

impl<S: Scalar> DriveInertia<S> {
    /// Of a wheel that turns at a steady rate.
    pub fn steady() -> Self {
        Self { torque_nm: S::zero(), may_jump: false }
    }

    /// The wheel stands, or has just started.
    pub fn unsettle(&mut self) {
        self.may_jump = true;
    }

    /// Takes by what the drive's torque, known to one such standard deviation, is larger than the resistive torque, N·m.
    pub fn follow(&mut self, larger_nm: S, std_nm: S) {
        let news = larger_nm - self.torque_nm;
        let jumps = if self.may_jump { S::one() } else { beyond(JUMPS, news, std_nm) };
        self.torque_nm += (S::constant(SHARE) + S::constant(1.0 - SHARE) * jumps) * news;
        self.may_jump = false;
    }

    /// What it takes, N·m, of a torque that is known to one such standard deviation.
    pub fn takes_nm(&self, std_nm: S) -> S {
        beyond(NOTHING, self.torque_nm, std_nm) * self.torque_nm
    }
}

/// From none to one, whether a torque is beyond so many standard deviations.
fn beyond<S: Scalar>(bound: f64, torque_nm: S, std_nm: S) -> S {
    let over = torque_nm.abs() - S::constant(bound - 0.5 * TURNS) * std_nm;
    let turns_nm = (S::constant(TURNS) * std_nm).max(S::constant(1.0e-12));
    (over / turns_nm).max(S::zero()).min(S::one())
}

#[cfg(test)]
mod tests {
    use super::DriveInertia;

    /// Torques off by their noise of 0.05 N·m, one way and the other.
    fn noise(frame: u32) -> f64 {
        if frame.is_multiple_of(2) { 0.05 } else { -0.05 }
    }

    #[test]
    fn noise_takes_nothing_and_a_change_of_speed_is_seen_at_once() {
        let mut inertia = DriveInertia::<f64>::steady();
        for frame in 0..100 {
            inertia.follow(noise(frame), 0.05);
            assert_eq!(inertia.takes_nm(0.05), 0.0);
        }
        inertia.follow(-0.63, 0.05);
        assert_eq!(inertia.takes_nm(0.05), -0.63);
        inertia.unsettle();
        inertia.follow(-0.5, 0.05);
        assert_eq!(inertia.takes_nm(0.05), -0.5);
    }

    #[test]
    fn a_slow_change_of_speed_is_seen_within_some_frames() {
        let mut inertia = DriveInertia::<f64>::steady();
        (0..20).for_each(|frame| inertia.follow(0.15 + noise(frame), 0.05));
        assert!((inertia.takes_nm(0.05) - 0.15).abs() < 0.02, "{}", inertia.takes_nm(0.05));
    }
}
