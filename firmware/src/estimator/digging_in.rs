//! Wheels that have stood dig in as they start.
//!
//! Loads shift from wheel to wheel and slips grow, and the hubs sink while they travel: their paths depart from the terrain, and come back
//! to it over some centimetres. Until then the links' pitches tell the contact angles as well as the paths do.

use super::contact_angle::{ContactAngleFilter, UNKNOWN_ANGLE};
use super::scale::Scale;
use crate::scalar::Scalar;

/// How fast the wheels of a side sink as they start, over the speed of their rims, as one standard deviation, and the travel after
/// which that is down to a third, m; under the wheels of set K0, and longer under larger ones.
const DIGS_IN: f64 = 0.1;
const DIGGING_IN_M: f64 = 0.013;
/// Where they sink by less than this they have dug in.
const DUG_IN: f64 = 0.003;
/// The least speed that paths are told by while wheels dig in, m/s.
const LEAST_SPEED: f64 = 3.0e-5;

/// How far the wheels of a side are from having dug in.
#[derive(Debug, Clone, Copy)]
pub(super) struct DiggingIn<S> {
    /// Variance of how fast the wheels sink, over the speed of their rims.
    variance: S,
    told_by_links: S,
    /// Share of the variance that is gone after a metre, 1/m.
    gone_per_m: S,
}

/// How a side rolled in a frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rolled<S> {
    /// Whether one of its wheels stands.
    pub stands: bool,
    /// How fast it travels, m/s, forward or back.
    pub speed_m_s: S,
    /// Speed of its rims, m/s.
    pub rim_speed_m_s: S,
    /// Time since the frame before, s.
    pub step_s: S,
}

impl<S: Scalar> DiggingIn<S> {
    /// They have dug in.
    pub fn new(scale: &Scale<S>) -> Self {
        let gone_per_m = S::constant(2.0 / DIGGING_IN_M) / scale.length;
        Self { variance: S::zero(), told_by_links: S::zero(), gone_per_m }
    }

    /// How much of what is known of the contact angles the links' pitches tell, 0 … 1: nothing where the wheels have dug in.
    pub fn told_by_links(&self) -> S {
        self.told_by_links
    }

    /// Lets wheels dig in that have stood: the path of a hub comes back to the terrain as it travels, and so drifts against it.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn follow(&mut self, rolled: &Rolled<S>, angles: &mut ContactAngleFilter<S>) {
        let square = |value: f64| S::constant(value * value);
        self.told_by_links = S::zero();
        if rolled.stands {
            self.variance = square(DIGS_IN);
        } else if self.variance > S::zero() {
            let speed = rolled.speed_m_s.max(S::constant(LEAST_SPEED));
            let came_back = self.variance * (self.gone_per_m * speed * rolled.step_s).min(S::one());
            self.variance -= came_back;
            let over_rim = rolled.rim_speed_m_s / speed;
            let squared = over_rim * over_rim;
            angles.dig_in(came_back * squared);
            let steeper = self.variance * squared;
            self.told_by_links = steeper / (steeper + square(UNKNOWN_ANGLE));
            if self.variance < square(DUG_IN) {
                self.variance = S::zero();
                angles.settle();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{ContactAngleFilter, DiggingIn, Rolled, Scale};
    use crate::rover::Rover;

    /// Over 13 mm of travel what wheels that stood sink by falls to 1/e, its variance to 1/e²; within 60 mm they have dug in, and the links
    /// tell nothing any more.
    #[test]
    fn wheels_dig_in_by_travel() {
        let rover = Rover::<f64>::assumed();
        let mut angles = ContactAngleFilter::new(&rover, 0).expect("a rover");
        let mut digging = DiggingIn::new(&Scale::of(&rover));
        let rolled = Rolled { stands: false, speed_m_s: 0.01, rim_speed_m_s: 0.01, step_s: 0.001 };
        digging.follow(&rolled, &mut angles);
        assert_eq!(digging.told_by_links(), 0.0);
        digging.follow(&Rolled { stands: true, ..rolled }, &mut angles);
        (0..1300).for_each(|_| digging.follow(&rolled, &mut angles));
        let (left, unknown) = (0.01 * (-2.0_f64).exp(), 0.04);
        assert!(
            (digging.told_by_links() / (left / (left + unknown)) - 1.0).abs() < 0.01,
            "{}",
            digging.told_by_links()
        );
        (0..4700).for_each(|_| digging.follow(&rolled, &mut angles));
        assert_eq!(digging.told_by_links(), 0.0);
    }
}
