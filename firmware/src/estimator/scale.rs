//! How much heavier a rover is than set K0, on which every force and torque among the filters' constants was found.
//!
//! What a wheel bears is what its soil can do to it: on the same ground, forces change in proportion to the load on a wheel, torques to
//! load times radius. A spread in newtons that is right for a wheel of K0, under 67 N, holds the filter of one under 300 N to forces
//! that its wheel left long ago. Larger wheels also take a longer way to dig in. Lighter rovers and smaller wheels keep the constants of
//! K0: their sensors are no better, and with tighter spreads the filters would state less than they err by.

use crate::rover::Rover;
use crate::scalar::Scalar;

/// Forces, torques and lengths of a rover over those of set K0, not below one; exactly one for K0, whose constants stay what they are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale<S> {
    /// Load on a wheel of the level rover at rest, over that of K0.
    pub force: S,
    /// That times the radius of the wheel, over that of K0.
    pub torque: S,
    /// Radius of the wheel, over that of K0.
    pub length: S,
}

impl<S: Scalar> Scale<S> {
    /// That of a rover.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn of(rover: &Rover<S>) -> Self {
        let assumed = Rover::<S>::assumed();
        let force = rover.load_at_rest_n() / assumed.load_at_rest_n();
        let length = rover.wheel.radius_m / assumed.wheel.radius_m;
        let [force, torque, length] = [force, force * length, length].map(|scale| scale.max(S::one()));
        Self { force, torque, length }
    }

    /// A force that was found on K0, N, for this rover.
    pub fn force_n(&self, of_assumed: f64) -> S {
        S::constant(of_assumed) * self.force
    }

    /// The ways over which forces and torques of K0 drift as far as those of this rover do over `travel_m`, m: variances grow with the way.
    pub fn travels_m(&self, travel_m: S) -> [S; 2] {
        [self.force * self.force * travel_m, self.torque * self.torque * travel_m]
    }
}

#[cfg(test)]
mod tests {
    use super::Scale;
    use crate::rover::Rover;

    const SAME: Scale<f64> = Scale { force: 1.0, torque: 1.0, length: 1.0 };

    /// K0 keeps its constants to the last bit, in both precisions, and so does a lighter rover on smaller wheels.
    #[test]
    fn up_to_the_weight_of_the_assumed_rover_constants_stay_what_they_are() {
        assert_eq!(Scale::of(&Rover::<f32>::assumed()), Scale { force: 1.0, torque: 1.0, length: 1.0 });
        assert_eq!(Scale::of(&Rover::<f64>::assumed()), SAME);
        let mut light = Rover::<f64>::assumed();
        (light.mass_kg, light.wheel.radius_m) = (8.0, 0.05);
        assert_eq!(Scale::of(&light), SAME);
    }

    /// A rover of twice the mass with wheels three times as large has twice the forces and six times the torques; what drifts so far
    /// in one metre takes K0 four and thirty-six.
    #[test]
    fn forces_go_with_the_load_and_torques_with_load_and_radius() {
        let mut rover = Rover::<f64>::assumed();
        rover.mass_kg *= 2.0;
        rover.wheel.radius_m *= 3.0;
        let scale = Scale::of(&rover);
        let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1.0e-12, "{found} {expected}");
        near(scale.force_n(3.0), 6.0);
        near(scale.torque, 6.0);
        near(scale.length, 3.0);
        let [of_forces, of_torques] = scale.travels_m(1.0);
        near(of_forces, 4.0);
        near(of_torques, 36.0);
    }
}
