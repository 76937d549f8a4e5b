//! How a bogie turns as load shifts between its wheels while they start.
//!
//! The torques of the drives take load from the middle wheel to the rear one, which sinks, and the other comes up: the bogie turns nose-up,
//! where nothing of the terrain turns it, and the hubs below its pivot go forward by that. Their slips are far less than those of wheels
//! whose hubs go as the terrain leads them.

use crate::rover::{PerAxle, Suspension};
use crate::scalar::Scalar;

/// How far links turn by that in a second, rad, as a random walk.
const TURNS: f64 = 0.01;
/// The rate is followed within so long, s: in less, the noise of the joint's sensor would be most of it.
const FOLLOWED_S: f64 = 0.1;
/// One standard deviation by which it is off, rad/s, and by which the rocker turns, which is not followed.
const UNTOLD_RAD_S: f64 = 0.01;
const OF_ROCKER_RAD_S: f64 = 0.002;

/// What it does to a hub.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HubShift<S> {
    /// How much faster the hub goes forward for it, m/s.
    pub faster_m_s: S,
    /// One standard deviation of what is not known of that, m/s.
    pub std_m_s: S,
}

/// What is known of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct LoadShift<S> {
    /// Rate of the bogie's pitch beside what rolling explains, rad/s, while wheels start.
    rate_rad_s: Option<S>,
}

impl<S: Scalar> LoadShift<S> {
    /// No wheel starts.
    pub fn none() -> Self {
        Self { rate_rad_s: None }
    }

    /// Begins a step in which wheels start, or do not: one standard deviation of what that turns links by in it, rad.
    pub fn begin(&mut self, starts: bool, step_s: S) -> S {
        self.rate_rad_s = starts.then(|| self.rate_rad_s.unwrap_or(S::zero()));
        if starts { S::constant(TURNS) * step_s.sqrt() } else { S::zero() }
    }

    /// Follows a bogie that was found to have turned by so much more than rolling explains in a step, rad.
    pub fn follow(&mut self, turned_rad: S, step_s: S) {
        if let Some(rate) = &mut self.rate_rad_s {
            *rate += (turned_rad - step_s * *rate) / (step_s + S::constant(FOLLOWED_S));
        }
    }

    /// What it does to each hub.
    pub fn hubs(&self, suspension: &Suspension<S>) -> PerAxle<HubShift<S>> {
        let still = HubShift { faster_m_s: S::zero(), std_m_s: S::zero() };
        let Some(rate) = self.rate_rad_s else { return PerAxle::all(still) };
        let of_bogie = |below_pivot_m: S| HubShift {
            faster_m_s: below_pivot_m * rate,
            std_m_s: below_pivot_m * S::constant(UNTOLD_RAD_S),
        };
        PerAxle {
            front: HubShift { std_m_s: -suspension.front_hub.z * S::constant(OF_ROCKER_RAD_S), ..still },
            middle: of_bogie(-suspension.middle_hub.z),
            rear: of_bogie(-suspension.rear_hub.z),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{HubShift, LoadShift};
    use crate::rover::{PerAxle, Rover};

    /// A bogie that turns nose-up by 0.05 rad/s takes hubs 0.1 m below its pivot forward by 5 mm/s; once no wheel starts, it is still.
    #[test]
    fn hubs_go_forward_under_a_bogie_that_turns_nose_up() {
        let suspension = Rover::<f64>::assumed().suspension;
        let mut shift = LoadShift::none();
        let mut hubs = |starts| {
            let turns = shift.begin(starts, 0.1);
            assert_eq!(turns > 0.0, starts);
            shift.follow(0.005, 0.1);
            shift.hubs(&suspension)
        };
        let still = HubShift { faster_m_s: 0.0, std_m_s: 0.0 };
        assert_eq!(hubs(false), PerAxle::all(still));
        let turned = (0..10).map(|_| hubs(true)).last().expect("frames");
        let (front, rear) = (turned.front, turned.rear);
        assert!((rear.faster_m_s / (0.05 * -suspension.rear_hub.z) - 1.0).abs() < 0.01, "{rear:?}");
        assert!(front.faster_m_s == 0.0 && front.std_m_s > 0.0 && rear.std_m_s > front.std_m_s, "{front:?} {rear:?}");
        assert_eq!(hubs(false), PerAxle::all(still));
    }
}
