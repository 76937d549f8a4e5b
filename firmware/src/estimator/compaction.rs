//! What a wheel's torque tells of its contact angle.
//!
//! Of the force on a rim, T/r, what is not drawbar pull compacts the soil: (T/r − DP)/W is the soil's, and hardly the slope's. Seen along
//! a contact angle that is too steep by dγ, the pull seems larger by W dγ and that share smaller by dγ. So a share that leaves what it was
//! tells by how much an angle is wrong: of a wheel that meets a slope or a rock before links and velocity have moved, and of one whose hub
//! sinks deeper, or less deep, in another soil, and whose path is then not the terrain. Of a bogie's two wheels only the sum of the pulls
//! is known, and so only their share together: (ΣT/r − ΣDP)/ΣW, smaller by the mean of their angles' errors, weighted by load.

use super::drawbar_split::BogieWheel;
use crate::scalar::Scalar;

/// Travel over which that mean is taken, m: soil that is another for so long is what there is.
pub(super) const REMEMBERED_M: f64 = 0.2;
/// A share farther from the mean than this counts for no more in it, and tells no more of an angle: soils differ by as much.
const GREATEST: f64 = 0.3;

/// The share of the rim force that compacts the soil, over the load: of one wheel, or of a bogie's two together.
#[derive(Debug, Clone, Copy)]
pub(super) struct Compaction<S> {
    mean: S,
    /// Travel that the mean was learned over, m, up to [`REMEMBERED_M`].
    way_m: S,
    /// How far it is from its mean now; none where no share of now is known.
    departure: Option<S>,
}

impl<S: Scalar> Compaction<S> {
    /// Nothing is known.
    pub fn new() -> Self {
        Self { mean: S::zero(), way_m: S::zero(), departure: None }
    }

    /// Forgets it: a wheel does not roll under a load, or digs in.
    pub fn forget(&mut self) {
        self.way_m = S::zero();
    }

    /// Nothing tells what it is now: pulls are not known.
    pub fn pause(&mut self) {
        self.departure = None;
    }

    /// Its mean.
    pub fn mean(&self) -> S {
        self.mean
    }

    /// Whether it has been learned.
    pub fn is_known(&self) -> bool {
        self.way_m > S::zero()
    }

    /// Whether it ever was: no soil's is exactly nothing.
    pub fn was_ever_known(&self) -> bool {
        self.mean != S::zero()
    }

    /// Takes the share after so much travel, m; without any nothing is learned. No soil's is beyond one; that of a load near nothing may be
    /// anything.
    pub fn follow(&mut self, travel_m: S, share: S) {
        if travel_m == S::zero() {
            return;
        }
        let share = share.max(-S::one()).min(S::one());
        if self.way_m == S::zero() {
            self.mean = share;
        }
        self.way_m = (self.way_m + travel_m).min(S::constant(REMEMBERED_M));
        let greatest = S::constant(GREATEST);
        let departure = (share - self.mean).max(-greatest).min(greatest);
        self.departure = Some(departure);
        self.mean += travel_m / self.way_m * departure;
    }

    /// The pull of such wheels together where they compact the soil as they did, N.
    pub fn pull_n(&self, wheels: &[&BogieWheel<S>]) -> S {
        wheels.iter().fold(S::zero(), |sum, wheel| sum + wheel.rim_force_n - self.mean * wheel.load_n)
    }

    /// How far the share is from its mean, and what of it is an error of the contact angle, over the variance by which that is known, rad²:
    /// the gain of Kalman's filter, less its last factor. On one soil the share departs from its mean by another variance.
    pub fn tells(&self, variance: S, by_itself: S) -> (S, S) {
        let Some(departure) = self.departure else { return (S::zero(), S::zero()) };
        (departure, self.way_m / (variance * self.way_m + S::constant(REMEMBERED_M) * by_itself))
    }
}

/// What the share, and a memory of the terrain, tell of one contact angle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Correction<S> {
    /// By how much the contact is steeper than the path of its hub, rad.
    pub steeper: S,
    /// How much the path of its hub tells beside the memory, 0 … 1.
    pub of_path: S,
    /// What the share leaves of the variance of the contact angle, and of what the angles make of that of the pull.
    pub left_of_angle: S,
    pub left_of_pull: S,
    /// By how much less steep the contact is taken to be for each newton by which its pull seems larger, rad/N.
    pub by_pull: S,
}

impl<S: Scalar> Correction<S> {
    /// It tells nothing.
    pub fn none() -> Self {
        let (zero, one) = (S::zero(), S::one());
        Self { steeper: zero, of_path: one, left_of_angle: one, left_of_pull: one, by_pull: zero }
    }

    /// The path of the hub has turned by so much since, rad; what is remembered of the terrain has not.
    pub fn turn_path(&mut self, by_rad: S) {
        self.steeper -= (S::one() - self.of_path) * by_rad;
    }

    /// Adds a memory of the terrain that tells so much of the contact angle, 0 … 1, and that it is so much steeper than the path, rad.
    pub fn remember(&mut self, told: S, steeper: S) {
        self.of_path = S::one() - told;
        self.steeper = self.of_path * self.steeper + told * steeper;
        self.by_pull = self.of_path * self.by_pull;
    }
}

/// What is known of a wheel's contact angle by the path of its hub.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known<S> {
    /// Its variance, rad²: where the track says that the path is not the terrain, more than `path_variance`.
    pub variance: S,
    /// That of the path as the path, rad².
    pub path_variance: S,
    /// Its covariance with the mean of the angles that the share is of, weighted by load, rad².
    pub with_mean: S,
}

/// The wheels that a share is of together.
#[derive(Debug, Clone, Copy)]
pub(super) struct Together<S> {
    /// How many they are.
    pub wheels: S,
    /// The load that they bear, N, more than none.
    pub load_n: S,
    /// Variance of the mean of their contact angles, weighted by load, rad².
    pub variance: S,
    /// That of the mean of their paths, rad².
    pub paths_variance: S,
    /// Variance of how far their share departs from its mean on one soil.
    pub departs: S,
}

impl<S: Scalar> Known<S> {
    /// What the share tells of it.
    pub fn corrected(&self, compaction: &Compaction<S>, together: &Together<S>) -> Correction<S> {
        let (departure, per_variance) = compaction.tells(together.variance, together.departs);
        let gain = self.with_mean * per_variance;
        let over = |left: S, variance: S| if variance > S::zero() { left / variance } else { S::one() };
        Correction {
            steeper: gain * departure,
            of_path: S::one(),
            left_of_angle: over(self.variance - gain * self.with_mean, self.path_variance),
            left_of_pull: over(
                together.variance * (S::one() - together.variance * per_variance),
                together.paths_variance,
            ),
            by_pull: together.wheels * gain / together.load_n,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{BogieWheel, Compaction, Correction, Known, Together};

    /// An angle that is too small by 0.05 rad for a moment, of a wheel that has rolled for long: known to 0.015 rad, it is half made good.
    #[test]
    fn a_share_that_grows_tells_a_steeper_contact() {
        let known = |std: f64| Known { variance: std * std, path_variance: std * std, with_mean: std * std };
        let told = |compaction: &Compaction<f64>, std: f64| {
            let alone = Together {
                wheels: 1.0,
                load_n: 70.0,
                variance: std * std,
                paths_variance: std * std,
                departs: 0.015 * 0.015,
            };
            let correction = known(std).corrected(compaction, &alone);
            (correction.steeper, correction.left_of_angle, correction.left_of_pull)
        };
        let mut compaction = Compaction::<f64>::new();
        assert_eq!(told(&compaction, 1.0), (0.0, 1.0, 1.0));
        (0..300).for_each(|_| compaction.follow(0.002, 0.2));
        compaction.follow(0.002, 0.25);
        let (steeper, left, of_pull) = told(&compaction, 0.015);
        assert!((steeper - 0.025).abs() < 1.0e-9 && (left - 0.5).abs() < 1.0e-9, "{steeper} {left}");
        assert_eq!(left, of_pull);
        let (steeper, left, _) = told(&compaction, 1.0e-4);
        assert!(steeper < 1.0e-5 && left > 0.999, "{steeper} {left}");
        assert_eq!(told(&compaction, 0.0), (0.0, 1.0, 1.0));
    }

    /// Of two wheels that know nothing of each other, the one that is known worse is corrected more, and what the two share is told of
    /// their mean alone.
    #[test]
    fn of_a_bogie_the_wheel_that_is_known_worse_is_corrected_more() {
        let mut compaction = Compaction::<f64>::new();
        (0..300).for_each(|_| compaction.follow(0.002, 0.2));
        compaction.follow(0.002, 0.25);
        let (well, badly) = (1.0e-4, 9.0e-4);
        let variance = 0.25 * (well + badly);
        let bogie =
            |paths_variance: f64| Together { wheels: 2.0, load_n: 140.0, variance, paths_variance, departs: 1.0e-4 };
        let of = |variance: f64, path_variance: f64| Known { variance, path_variance, with_mean: 0.5 * variance };
        // Known worse since the track says that its path is not the terrain: then as much is left, over less that is stated.
        let of_track = of(badly, well).corrected(&compaction, &bogie(0.5 * well));
        let [well, badly] = [well, badly].map(|known| of(known, known).corrected(&compaction, &bogie(variance)));
        assert_eq!(of_track.steeper, badly.steeper);
        assert!((of_track.left_of_angle / badly.left_of_angle - 9.0).abs() < 1.0e-9);
        assert!((of_track.left_of_pull / badly.left_of_pull - 5.0).abs() < 1.0e-9);
        assert!((badly.steeper / well.steeper - 9.0).abs() < 1.0e-9);
        let mean = 0.5 * (well.steeper + badly.steeper);
        assert!((mean - 0.05 * (1.0 - well.left_of_pull)).abs() < 1.0e-12, "{mean}");
        assert!(badly.left_of_angle < well.left_of_angle && well.left_of_angle > 0.9);
    }

    /// A terrain that is remembered is as steep as before, however the path of the hub turns; where only the path tells it, that is followed.
    #[test]
    fn what_is_remembered_does_not_turn_with_the_path() {
        let (terrain, path, turned) = (0.1, 0.02, 0.05);
        for told in [0.0, 0.6, 1.0] {
            let mut correction = Correction::<f64>::none();
            correction.remember(told, terrain - path);
            let before = path + correction.steeper;
            correction.turn_path(turned);
            let angle = path + turned + correction.steeper;
            assert!((angle - before - (1.0 - told) * turned).abs() < 1.0e-12, "{told}: {before} {angle}");
        }
    }

    /// A soil that is another for long is the soil, however much it is another: within three times the way nineteen twentieths are learned.
    #[test]
    fn another_soil_is_learned_over_its_way() {
        for other in [0.3, 0.45] {
            let mut compaction = Compaction::<f64>::new();
            (0..300).for_each(|_| compaction.follow(0.002, 0.2));
            let departs = |compaction: &Compaction<f64>| compaction.tells(1.0, 1.0e-4).0;
            (0..300).for_each(|_| compaction.follow(0.002, other));
            assert!(departs(&compaction).abs() < 0.05 * (other - 0.2), "{}", departs(&compaction));
            (0..300).for_each(|_| compaction.follow(0.002, other));
            assert!(departs(&compaction).abs() < 0.001, "{}", departs(&compaction));
        }
    }

    /// A wheel that has not travelled teaches nothing, not even that nothing is known.
    #[test]
    fn a_share_without_travel_is_not_learned() {
        let mut compaction = Compaction::<f64>::new();
        compaction.follow(0.0, 0.2);
        assert!(!compaction.is_known() && !compaction.was_ever_known());
    }

    /// Where pulls are not known the share is nobody's: nothing is told, and what was learned stays for the time after.
    #[test]
    fn a_pause_tells_nothing_and_forgets_nothing() {
        let mut compaction = Compaction::<f64>::new();
        assert!(!compaction.is_known());
        (0..300).for_each(|_| compaction.follow(0.002, 0.2));
        compaction.pause();
        assert_eq!(compaction.tells(1.0, 1.0e-4), (0.0, 0.0));
        let wheel = BogieWheel { load_n: 100.0, rim_force_n: 30.0, slip: 0.1, direction: 1.0 };
        assert!(compaction.is_known() && (compaction.pull_n(&[&wheel]) - 10.0).abs() < 1.0e-9);
        compaction.follow(0.002, 0.25);
        assert!((compaction.tells(1.0, 1.0e-4).0 - 0.05).abs() < 1.0e-9);
    }

    /// A load near nothing makes a share of any size, and that tells no angle.
    #[test]
    fn an_absurd_share_tells_little() {
        let mut compaction = Compaction::<f64>::new();
        (0..300).for_each(|_| compaction.follow(0.002, 0.2));
        compaction.follow(0.002, f64::INFINITY);
        let (departure, _) = compaction.tells(1.0, 1.0e-4);
        assert_eq!(departure, 0.3);
    }
}
