//! Moments that balance on a rover whose links are massless.

use super::{Axes, PerAxle, Planar, Rover, SideLayout};
use crate::scalar::Scalar;

/// Where and how a wheel bears on the soil: the terrain's slope under its hub.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HubContact<S> {
    /// Along the terrain, forward.
    pub tangent: Planar<S>,
    /// Out of the terrain, upward.
    pub normal: Planar<S>,
}

impl<S: Scalar> HubContact<S> {
    /// A contact at an angle, in the coordinates that the angle is measured in, rad, positive uphill.
    pub fn at(angle_rad: S) -> Self {
        Self::along(Planar::direction(angle_rad.sin_cos()))
    }

    /// A contact along a direction of length one, forward.
    pub fn along(tangent: Planar<S>) -> Self {
        Self { tangent, normal: Planar { x: -tangent.z, z: tangent.x } }
    }

    /// The force of the soil on the hub, N.
    pub fn hub_force_n(&self, normal_load_n: S, drawbar_pull_n: S) -> Planar<S> {
        self.normal.scaled(normal_load_n) + self.tangent.scaled(drawbar_pull_n)
    }
}

/// Moment on a bogie about its pivot, N·m, positive nose-down; zero when it balances.
///
/// The soil's forces on the two hubs, less the resistive torques: a link feels minus the torque of the soil on its wheel.
pub fn bogie_moment_nm<S: Scalar>(layout: &SideLayout<S>, forces_n: &PerAxle<Planar<S>>, torques_nm: &PerAxle<S>) -> S {
    let arm = |hub: Planar<S>| hub - layout.bogie_pivot;
    arm(layout.hubs.middle).moment_nm(forces_n.middle) + arm(layout.hubs.rear).moment_nm(forces_n.rear)
        - torques_nm.middle
        - torques_nm.rear
}

/// Moment on a rocker about the differential axis, N·m, positive nose-down, with the force of a bogie that balances; it
/// is minus half of [`body_moment_nm`] when the rover balances.
pub fn rocker_moment_nm<S: Scalar>(
    layout: &SideLayout<S>,
    forces_n: &PerAxle<Planar<S>>,
    torques_nm: &PerAxle<S>,
) -> S {
    layout.hubs.front.moment_nm(forces_n.front) - torques_nm.front
        + layout.bogie_pivot.moment_nm(forces_n.middle + forces_n.rear)
}

/// Moment of the body's weight and inertia about the differential axis, N·m, positive nose-down, from the specific force
/// that the accelerometer feels (m/s²). The differential halves it: it holds the rockers' angles against the body equal
/// and opposite, and turns their moments equal by that (principle of virtual work).
pub fn body_moment_nm<S: Scalar>(rover: &Rover<S>, specific_force_m_s2: &Axes<S>) -> S {
    let centre = rover.suspension.centre_of_mass;
    rover.mass_kg * (centre.x * specific_force_m_s2.z - centre.z * specific_force_m_s2.x)
}

#[cfg(test)]
mod tests {
    use super::{HubContact, bogie_moment_nm, rocker_moment_nm};
    use crate::rover::{LinkAngles, PerAxle, Rover, Side, SideLayout};

    /// The closed form for level ground: DP2 + DP3 = (x3' W3 − x2 W2 − τ2 − τ3) / h_B.
    #[test]
    fn on_level_ground_the_bogie_gives_the_sum_of_its_drawbar_pulls() {
        let rover = Rover::<f64>::assumed();
        let layout = SideLayout::new(&rover, Side::Left, &LinkAngles::default());
        let (loads, torques) = ([66.0, 60.0, 75.0], [1.5, 1.3, 1.7]);
        let sum = (0.175 * loads[2] - 0.175 * loads[1] - torques[1] - torques[2]) / 0.10;
        let level = HubContact::at(0.0);
        let forces = PerAxle {
            front: level.hub_force_n(loads[0], 1.0),
            middle: level.hub_force_n(loads[1], 0.25 * sum),
            rear: level.hub_force_n(loads[2], 0.75 * sum),
        };
        let moment = bogie_moment_nm(&layout, &forces, &PerAxle::from_array(torques));
        assert!(moment.abs() < 1.0e-12, "{moment}");
        // About the differential axis, by hand: arms 0.2 m and 0.1 m for pulls, 0.35 m and 0.175 m for loads.
        let by_hand = -0.20 * 1.0 - 0.35 * loads[0] - torques[0] - 0.10 * sum + 0.175 * (loads[1] + loads[2]);
        let moment = rocker_moment_nm(&layout, &forces, &PerAxle::from_array(torques));
        assert!((moment - by_hand).abs() < 1.0e-12, "{moment} {by_hand}");
    }
}
