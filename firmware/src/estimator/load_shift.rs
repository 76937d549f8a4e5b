//! How the body and its bogies turn as load shifts between wheels that start.
//!
//! The torques of the drives take load from the wheels in front to those behind, which sink, and the others come up: body and bogies turn
//! nose-up, where nothing of the terrain turns them, and the hubs below go forward by that. Their slips are far less than those of wheels
//! whose hubs go as the terrain leads them. The gyro tells how the body turns, and rockers are taken to turn with it; a bogie's joint tells
//! how that turns besides.

use crate::rover::{PerAxle, Suspension};
use crate::scalar::Scalar;

/// How far links turn by that in a second, rad, as a random walk.
const TURNS: f64 = 0.01;
/// A bogie's rate is followed within so long, s: in less, the noise of the joint's sensor would be most of it.
const FOLLOWED_S: f64 = 0.1;
/// One standard deviation by which that is off, rad/s, and by which a rocker turns otherwise than the body.
const UNTOLD_RAD_S: f64 = 0.01;
const OF_ROCKER_RAD_S: f64 = 0.001;

/// What it does to a hub.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HubShift<S> {
    /// How much faster the hub goes forward for it, m/s.
    pub faster_m_s: S,
    /// One standard deviation of what is not known of that, m/s.
    pub std_m_s: S,
}

/// What is known of it: rates of pitch beside what rolling explains, while wheels start.
#[derive(Debug, Clone, Copy)]
pub(super) struct LoadShift<S> {
    rates: Option<Rates<S>>,
}

/// Of the rocker, with its standard deviation, and of the bogie against it, rad/s.
#[derive(Debug, Clone, Copy)]
struct Rates<S> {
    rocker: S,
    rocker_std: S,
    joint: S,
}

impl<S: Scalar> LoadShift<S> {
    /// No wheel starts.
    pub fn none() -> Self {
        Self { rates: None }
    }

    /// Begins a step. Where wheels start in it, `turns` is the rate at which the body turns beside what rolling explains, with its standard
    /// deviation, rad/s. Gives one standard deviation of what load turns links by in it, rad.
    pub fn begin(&mut self, turns: Option<(S, S)>, step_s: S) -> S {
        let joint = self.rates.map_or(S::zero(), |rates| rates.joint);
        self.rates = turns.map(|(rocker, std)| Rates { rocker, rocker_std: std + S::constant(OF_ROCKER_RAD_S), joint });
        if turns.is_some() { S::constant(TURNS) * step_s.sqrt() } else { S::zero() }
    }

    /// Follows a bogie that was found to have turned by so much more than rolling explains in a step, rad.
    pub fn follow(&mut self, turned_rad: S, step_s: S) {
        if let Some(Rates { rocker, joint, .. }) = &mut self.rates {
            *joint += (turned_rad - step_s * (*rocker + *joint)) / (step_s + S::constant(FOLLOWED_S));
        }
    }

    /// What it does to each hub.
    pub fn hubs(&self, suspension: &Suspension<S>) -> PerAxle<HubShift<S>> {
        let still = HubShift { faster_m_s: S::zero(), std_m_s: S::zero() };
        let Some(Rates { rocker, rocker_std, joint }) = self.rates else { return PerAxle::all(still) };
        let of_rocker =
            |below_axis_m: S| HubShift { faster_m_s: below_axis_m * rocker, std_m_s: below_axis_m * rocker_std };
        let pivot = of_rocker(-suspension.bogie_pivot.z);
        let of_bogie = |below_pivot_m: S| HubShift {
            faster_m_s: pivot.faster_m_s + below_pivot_m * (rocker + joint),
            std_m_s: pivot.std_m_s + below_pivot_m * S::constant(UNTOLD_RAD_S),
        };
        PerAxle {
            front: of_rocker(-suspension.front_hub.z),
            middle: of_bogie(-suspension.middle_hub.z),
            rear: of_bogie(-suspension.rear_hub.z),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{HubShift, LoadShift};
    use crate::rover::{PerAxle, Rover};

    /// What ten frames make of it in which wheels start, where the body turns by this rate and rolling explains so much less of how the
    /// bogie turns, rad/s; once no wheel starts, hubs are still.
    fn turned(body_rad_s: f64, bogie_rad_s: f64) -> PerAxle<HubShift<f64>> {
        let suspension = Rover::<f64>::assumed().suspension;
        let mut shift = LoadShift::none();
        let mut hubs = |turns: Option<(f64, f64)>| {
            assert_eq!(shift.begin(turns, 0.1) > 0.0, turns.is_some());
            shift.follow(0.1 * bogie_rad_s, 0.1);
            shift.hubs(&suspension)
        };
        let still = PerAxle::all(HubShift { faster_m_s: 0.0, std_m_s: 0.0 });
        assert_eq!(hubs(None), still);
        let turned = (0..10).map(|_| hubs(Some((body_rad_s, 0.001)))).last().expect("frames");
        assert_eq!(hubs(None), still);
        turned
    }

    /// A bogie that turns nose-up by 0.05 rad/s takes hubs 0.1 m below its pivot forward by 5 mm/s.
    #[test]
    fn hubs_go_forward_under_a_bogie_that_turns_nose_up() {
        let PerAxle { front, rear, .. } = turned(0.0, 0.05);
        assert!((rear.faster_m_s - 0.005).abs() < 5.0e-5, "{rear:?}");
        assert!(front.faster_m_s == 0.0 && front.std_m_s > 0.0 && rear.std_m_s > front.std_m_s, "{front:?} {rear:?}");
    }

    /// A body that turns nose-up by 0.02 rad/s, and its bogies with it, takes hubs 0.2 m below its axis forward by 4 mm/s.
    #[test]
    fn hubs_go_forward_under_a_body_that_turns_nose_up() {
        let PerAxle { front, middle, rear } = turned(0.02, 0.02);
        for hub in [front, middle, rear] {
            assert!((hub.faster_m_s - 0.004).abs() < 1.0e-6, "{hub:?}");
        }
    }
}
