//! What both sides carry and pull together holds the rover: the balance of forces on the whole of it.
//!
//! The moments about pivots and axis tell each side's pulls from torques and load cells, with errors of a newton a frame. The
//! sum of both sides is known far better: a rover that hardly accelerates weighs m g, and pulls m g sin(pitch), and
//! accelerometer and gyro hold the pitch to half a milliradian. That pitch comes from a filter, its error lasts, and so it may not be
//! taken anew in each frame as a measurement of the sides' filters. It meets what they say when that is read, and nothing goes
//! back: they know nothing of each other, nor of the pitch, so that the errors that meet are independent.

use super::attitude::Attitude;
use super::hub_force::STATES;
use crate::filter::Gaussian;
use crate::rover::{PerSide, Rover};
use crate::scalar::Scalar;

/// How surely the rover's weight tells what holds it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Steadiness {
    /// Its wheels roll as they will.
    Steady,
    /// Wheels start, stop or stand.
    Unsteady,
    /// An angle of a link is surmised. What its wheels bear has then any part along the body.
    Unknown,
}

impl Steadiness {
    /// One standard deviation of what the rover accelerates by, m/s²: half a centimetre a second in every second; a top speed of 3 cm/s,
    /// reached in half a second; or so much that nothing is told.
    fn accelerates_m_s2(self) -> f64 {
        match self {
            Self::Steady => 0.005,
            Self::Unsteady => 0.06,
            Self::Unknown => 2.0,
        }
    }
}

/// What a side's filter says of the forces on its hubs beyond those of a level rover at rest, and the weights with which forces sum to
/// the side's force on the rover.
#[derive(Debug, Clone, Copy)]
pub(super) struct SideForces<'a, S> {
    /// What the filter says.
    pub estimate: &'a Gaussian<S, STATES>,
    /// Weights of the sum forward in the body's axes.
    pub forward: [S; STATES],
    /// Weights of the sum upward.
    pub upward: [S; STATES],
}

/// A force in the body's axes, forward and upward, N, with variances and covariance, N².
#[derive(Debug, Clone, Copy)]
struct Force<S> {
    forward: S,
    upward: S,
    forward_variance: S,
    upward_variance: S,
    covariance: S,
}

/// The forces on the hubs of both sides, so that together they hold the rover.
pub(super) fn balanced<S: Scalar>(
    rover: &Rover<S>,
    attitude: &Attitude<S>,
    steadiness: Steadiness,
    sides: &PerSide<SideForces<'_, S>>,
) -> PerSide<Gaussian<S, STATES>> {
    let PerSide { left, right } = sides;
    let at_rest_n = rover.load_at_rest_n();
    let whole =
        what_holds(rover, attitude, steadiness).less(&left.of_cells(at_rest_n)).less(&right.of_cells(at_rest_n));
    PerSide { left: left.with(&whole.less(&right.sum())), right: right.with(&whole.less(&left.sum())) }
}

/// The force that holds the rover: as much as it weighs, seen in the body's axes.
fn what_holds<S: Scalar>(rover: &Rover<S>, attitude: &Attitude<S>, steadiness: Steadiness) -> Force<S> {
    let square = |value: S| value * value;
    let across = attitude.specific_force_m_s2().y;
    // What a roll leaves of gravity in the plane of the sides.
    let in_plane = (square(rover.gravity_m_s2) - square(across)).max(S::zero()).sqrt();
    let (sine, cosine) = attitude.pitch_rad().sin_cos();
    let weight = rover.mass_kg * in_plane;
    let (forward, upward) = (weight * sine, weight * cosine);
    let accelerated = square(rover.mass_kg * S::constant(steadiness.accelerates_m_s2()));
    let pitch = attitude.pitch_variance();
    Force {
        forward,
        upward,
        forward_variance: accelerated + square(upward) * pitch,
        // Of a pitch that is hardly known the cosine is not, either.
        upward_variance: accelerated + square(forward) * pitch + S::constant(0.5) * square(upward * pitch),
        covariance: -forward * upward * pitch,
    }
}

impl<S: Scalar> Force<S> {
    /// What is left for one side where the other takes its part.
    fn less(&self, other: &Self) -> Self {
        Self {
            forward: self.forward - other.forward,
            upward: self.upward - other.upward,
            forward_variance: self.forward_variance + other.forward_variance,
            upward_variance: self.upward_variance + other.upward_variance,
            covariance: self.covariance + other.covariance,
        }
    }
}

impl<'a, S: Scalar> SideForces<'a, S> {
    /// Of a side whose rocker and bogie are at angles to the body of which sine and cosine are given.
    pub fn new(
        estimate: &'a Gaussian<S, STATES>,
        (rocker, across_rocker): (S, S),
        (bogie, across_bogie): (S, S),
    ) -> Self {
        Self {
            estimate,
            forward: [-rocker, -bogie, -bogie, across_rocker, across_bogie],
            upward: [across_rocker, across_bogie, across_bogie, rocker, bogie],
        }
    }

    /// The force of this side on the rover where each of its cells bears so much, N, and nothing is along the links.
    fn of_cells(&self, force_n: S) -> Force<S> {
        let sum = |[front, middle, rear, ..]: [S; STATES]| force_n * (front + middle + rear);
        let zero = S::zero();
        Force {
            forward: sum(self.forward),
            upward: sum(self.upward),
            forward_variance: zero,
            upward_variance: zero,
            covariance: zero,
        }
    }

    #[inline(never)] // flash is scarcer than the time of a call
    fn sum(&self) -> Force<S> {
        let (forward, forward_variance) = self.estimate.weighted_sum(&self.forward);
        let (upward, upward_variance) = self.estimate.weighted_sum(&self.upward);
        let covariance = self.estimate.covariance_of_sums(&self.forward, &self.upward);
        Force { forward, upward, forward_variance, upward_variance, covariance }
    }

    /// What the filter says, told the force that its side must come to.
    #[inline(never)] // as above
    fn with(&self, force: &Force<S>) -> Gaussian<S, STATES> {
        let mut estimate = *self.estimate;
        estimate.take(&self.upward, force.upward, force.upward_variance);
        // Of the forward force that part whose error has nothing to do with that of the upward one.
        let share = force.covariance / force.upward_variance;
        let mut forward = self.forward;
        forward.iter_mut().zip(&self.upward).for_each(|(weight, upward)| *weight -= share * *upward);
        // Two variances of which neither is below the acceleration's: the rest stays positive but for rounding.
        let rest = (force.forward_variance - share * force.covariance).max(S::constant(1.0e-3));
        estimate.take(&forward, force.forward - share * force.upward, rest);
        estimate
    }
}

#[cfg(test)]
mod tests {
    use super::{Force, SideForces};
    use crate::filter::Gaussian;

    /// One side at the level, told that it carries 210 N and pulls 6 N, more surely than it knows either itself: what it lacks
    /// goes to the forces in proportion to their variances, and its sums come out as told.
    #[test]
    fn what_a_side_lacks_goes_to_the_forces_that_are_known_least() {
        let mean: [f64; 5] = [70.0, 60.0, 65.0, 2.0, 1.0];
        let estimate = Gaussian::independent(mean, [1.0, 2.0, 1.0, 1.0, 2.0]).expect("numbers");
        let side = SideForces::new(&estimate, (0.0, 1.0), (0.0, 1.0));
        let told =
            Force { forward: 6.0, upward: 210.0, forward_variance: 0.01, upward_variance: 0.01, covariance: 0.0 };
        let balanced = side.with(&told);
        // 15 N upward by 1 : 4 : 1 of 6.01, 3 N forward by 1 : 4 of 5.01.
        let (up, on) = (15.0 / 6.01, 3.0 / 5.01);
        let expected: [f64; 5] = [70.0 + up, 60.0 + 4.0 * up, 65.0 + up, 2.0 + on, 1.0 + 4.0 * on];
        for (found, expected) in balanced.mean().iter().zip(expected) {
            assert!((found - expected).abs() < 1.0e-9, "{:?}", balanced.mean());
        }
        assert!((balanced.weighted_sum(&side.upward).1 - 6.0 * 0.01 / 6.01).abs() < 1.0e-9);
    }

    /// Errors that belong together: what is told forward and upward with a covariance must come to the joint answer, which for
    /// a side that knows next to nothing is what it was told.
    #[test]
    fn correlated_forces_are_taken_as_such() {
        let estimate = Gaussian::independent([60.0_f64, 60.0, 60.0, 0.0, 0.0], [1.0e3; 5]).expect("numbers");
        let side = SideForces::new(&estimate, (0.1, 0.995), (-0.05, 0.999));
        let told =
            Force { forward: 30.0, upward: 190.0, forward_variance: 4.0, upward_variance: 1.0, covariance: -1.5 };
        let sum = side.with(&told).weighted_sum(&side.forward);
        let covariance = side.with(&told).covariance_of_sums(&side.forward, &side.upward);
        assert!((sum.0 - 30.0).abs() < 1.0e-3 && (sum.1 - 4.0).abs() < 1.0e-3, "{sum:?}");
        assert!((covariance + 1.5).abs() < 1.0e-3, "{covariance}");
    }
}
