//! What a wheel's torque tells of its contact angle.
//!
//! Of the force on a rim, T/r, what is not drawbar pull compacts the soil: (T/r − DP)/W is the soil's, and hardly the slope's. Seen along
//! a contact angle that is too steep by dγ, the pull seems larger by W dγ and that share smaller by dγ. So a share that leaves what it was
//! tells by how much an angle is wrong: of a wheel that meets a slope or a rock before links and velocity have moved, and of one whose hub
//! sinks deeper, or less deep, in another soil, and whose path is then not the terrain.

use crate::scalar::Scalar;

/// One standard deviation of how far the share departs from its mean on one soil.
const SPREAD: f64 = 0.015;
/// Travel over which that mean is taken, m: soil that is another for so long is what there is.
const REMEMBERED_M: f64 = 0.2;
/// A share farther from the mean than this counts for no more in it.
const GREATEST: f64 = 0.1;

/// The share of one wheel's rim force that compacts the soil, over its load.
#[derive(Debug, Clone, Copy)]
pub(super) struct Compaction<S> {
    mean: S,
    /// Travel that the mean was learned over, m, up to [`REMEMBERED_M`].
    way_m: S,
    departure: S,
}

impl<S: Scalar> Compaction<S> {
    /// Nothing is known.
    pub fn new() -> Self {
        Self { mean: S::zero(), way_m: S::zero(), departure: S::zero() }
    }

    /// Forgets it: the wheel does not roll under a load.
    pub fn forget(&mut self) {
        self.way_m = S::zero();
    }

    /// Takes the share after so much travel, m, more than none.
    pub fn follow(&mut self, travel_m: S, share: S) {
        if self.way_m == S::zero() {
            self.mean = share;
        }
        self.way_m = (self.way_m + travel_m).min(S::constant(REMEMBERED_M));
        self.departure = share - self.mean;
        let greatest = S::constant(GREATEST);
        self.mean += travel_m / self.way_m * self.departure.max(-greatest).min(greatest);
    }

    /// What to add to a contact angle that is known with such a variance, rad², and what of that variance is left.
    pub fn tells(&self, variance: S) -> (S, S) {
        let told = variance * self.way_m;
        let left = S::constant(SPREAD * SPREAD * REMEMBERED_M);
        let gain = told / (told + left);
        (gain * self.departure, S::one() - gain)
    }
}

#[cfg(test)]
mod tests {
    use super::Compaction;

    /// An angle that is too small by 0.05 rad for a moment, of a wheel that has rolled for long: known to 0.015 rad, it is half made good.
    #[test]
    fn a_share_that_grows_tells_a_steeper_contact() {
        let mut compaction = Compaction::<f64>::new();
        assert_eq!(compaction.tells(1.0), (0.0, 1.0));
        (0..300).for_each(|_| compaction.follow(0.002, 0.2));
        compaction.follow(0.002, 0.25);
        let (shift, left) = compaction.tells(0.015 * 0.015);
        assert!((shift - 0.025).abs() < 1.0e-9 && (left - 0.5).abs() < 1.0e-9, "{shift} {left}");
        let (shift, left) = compaction.tells(1.0e-8);
        assert!(shift < 1.0e-5 && left > 0.999, "{shift} {left}");
    }

    /// A soil that is another for long is the soil.
    #[test]
    fn another_soil_is_learned_over_its_way() {
        let mut compaction = Compaction::<f64>::new();
        (0..300).for_each(|_| compaction.follow(0.002, 0.2));
        (0..600).for_each(|_| compaction.follow(0.002, 0.3));
        let (shift, _) = compaction.tells(1.0);
        assert!(shift.abs() < 0.001, "{shift}");
    }
}
