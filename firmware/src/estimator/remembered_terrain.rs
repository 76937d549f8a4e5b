//! The terrain under the wheels of a side, as it is remembered where they have stood.
//!
//! While wheels start, the paths of their hubs tell little of it: they creep below what the velocimeter sees, and dig in. But the terrain is
//! what it was where the wheels came to stand. On the way on, the memory is lost at the rate by which contact angles drift, until no more is
//! known than that the terrain is about as steep as the links; once the paths tell as much, it is what they say.

use super::contact_angle::{ContactAngleFilter, STEEPER_THAN_LINK};
use crate::rover::PerAxle;
use crate::scalar::Scalar;

/// What is remembered.
#[derive(Debug, Clone, Copy)]
pub(super) struct RememberedTerrain<S> {
    /// The slopes under the wheels, rad, and the variance of each, rad².
    slopes_rad: PerAxle<S>,
    variance: S,
    /// Whether the wheels have stood since the paths of their hubs told as much.
    is_asked: bool,
    /// How much of what is known of the contact angles it tells, 0 … 1.
    told: S,
    /// Variance of each contact angle beside that which the path of its hub makes, rad².
    beside_paths: S,
}

impl<S: Scalar> RememberedTerrain<S> {
    /// Nothing is remembered, and whether the wheels have stood is not known.
    pub fn unknown() -> Self {
        let zero = S::zero();
        let variance = S::constant(STEEPER_THAN_LINK * STEEPER_THAN_LINK);
        Self { slopes_rad: PerAxle::all(zero), variance, is_asked: true, told: zero, beside_paths: zero }
    }

    /// The wheels stand.
    pub fn ask(&mut self) {
        self.is_asked = true;
    }

    /// By what variance each contact angle errs beside what the path of its hub makes, rad².
    pub fn beside_paths(&self) -> S {
        self.beside_paths
    }

    /// How much of what is known of the contact angles it tells, 0 … 1, and by how much it says that they are steeper than the paths of the
    /// hubs, rad; none where it is not asked.
    pub fn tells(&self, angles: &ContactAngleFilter<S>) -> Option<(S, PerAxle<S>)> {
        let steeper = || self.slopes_rad.zip(angles.angles()).map(|(slope, path)| slope - path);
        self.is_asked.then(|| (self.told, steeper()))
    }

    /// Goes on to where the wheels are now, whose hubs go along the terrain but for an angle of variance `departs`, rad².
    pub fn follow(&mut self, angles: &ContactAngleFilter<S>, departs: S) {
        let zero = S::zero();
        let drift = angles.drift_variance();
        let of_paths = angles.mean_variance() + departs;
        if departs == zero && of_paths <= self.variance + drift {
            let slopes_rad = angles.angles();
            *self = Self { slopes_rad, variance: of_paths, is_asked: false, told: zero, beside_paths: zero };
            return;
        }
        let unknown = S::constant(STEEPER_THAN_LINK * STEEPER_THAN_LINK);
        let lost = if self.variance < unknown { (drift / unknown).min(S::one()) } else { S::one() };
        self.variance += lost * (unknown - self.variance);
        for (slope, link) in self.slopes_rad.as_mut().zip(angles.links()).into_array() {
            *slope += lost * (link - *slope);
        }
        if self.is_asked {
            self.told = of_paths / (of_paths + self.variance);
            let by_paths = S::one() - self.told;
            self.beside_paths = by_paths * by_paths * departs + self.told * self.told * self.variance;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{ContactAngleFilter, RememberedTerrain};
    use crate::rover::{PerAxle, Rover};

    fn remembered(variance: f64) -> RememberedTerrain<f64> {
        RememberedTerrain { slopes_rad: PerAxle::all(0.1), variance, is_asked: false, ..RememberedTerrain::unknown() }
    }

    /// A terrain that is known to 0.01 rad tells the angles of wheels that start, since their hubs may go down by 0.1; wheels that have not
    /// stood do not ask for it.
    #[test]
    fn it_is_what_it_was_where_wheels_stood() {
        let angles = ContactAngleFilter::new(&Rover::<f64>::assumed(), 0);
        let mut terrain = remembered(1.0e-4);
        terrain.follow(&angles, 0.01);
        assert!(terrain.tells(&angles).is_none() && terrain.beside_paths() == 0.0);
        terrain.ask();
        terrain.follow(&angles, 0.01);
        let (told, steeper) = terrain.tells(&angles).expect("wheels have stood");
        assert!(steeper == PerAxle::all(0.1) && told > 0.99, "{steeper:?} {told}");
        let by_paths = (1.0 - told) * (1.0 - told) * angles.mean_variance();
        assert!(terrain.beside_paths() + by_paths < 1.0e-4);
    }

    /// Nor is it asked any more once the paths of the hubs tell as much, and then it is what these say.
    #[test]
    fn paths_that_tell_as_much_take_its_place() {
        let angles = ContactAngleFilter::new(&Rover::<f64>::assumed(), 0);
        let mut terrain = remembered(1.1 * angles.mean_variance());
        terrain.ask();
        terrain.follow(&angles, 0.0);
        assert!(terrain.tells(&angles).is_none() && terrain.slopes_rad == PerAxle::all(0.0));
    }
}
