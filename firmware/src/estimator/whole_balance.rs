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

/// One standard deviation of what the rover accelerates by while its wheels roll as they will, m/s²: half a centimetre a
/// second in every second.
const STEADY: f64 = 0.005;
/// The same while wheels start, stop or stand, m/s²: a top speed of 3 cm/s, reached in half a second.
const UNSTEADY: f64 = 0.06;

/// What a side's filter says of the forces on its hubs, and the weights with which these sum to the side's force on the rover.
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
    steady: bool,
    sides: &PerSide<SideForces<'_, S>>,
) -> PerSide<Gaussian<S, STATES>> {
    let whole = what_holds(rover, attitude, steady);
    let PerSide { left, right } = sides;
    PerSide { left: left.with(&whole.less(&right.sum())), right: right.with(&whole.less(&left.sum())) }
}

/// The force that holds the rover: as much as it weighs, seen in the body's axes.
fn what_holds<S: Scalar>(rover: &Rover<S>, attitude: &Attitude<S>, steady: bool) -> Force<S> {
    let square = |value: S| value * value;
    let across = attitude.specific_force_m_s2().y;
    // What a roll leaves of gravity in the plane of the sides.
    let in_plane = (square(rover.gravity_m_s2) - square(across)).max(S::zero()).sqrt();
    let (sine, cosine) = attitude.pitch_rad().sin_cos();
    let weight = rover.mass_kg * in_plane;
    let (forward, upward) = (weight * sine, weight * cosine);
    let accelerated = square(rover.mass_kg * S::constant(if steady { STEADY } else { UNSTEADY }));
    let pitch = attitude.pitch_variance();
    Force {
        forward,
        upward,
        forward_variance: accelerated + square(upward) * pitch,
        upward_variance: accelerated + square(forward) * pitch,
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
