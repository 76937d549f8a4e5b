//! Where the hubs of a side are and how fast they move.

use super::{Axes, PerAxle, Planar, Rover, Side};
use crate::scalar::Scalar;

/// A link's pitch against what carries it, a rocker's against the body and a bogie's against its rocker, and how fast it changes; nose-up.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Link<S> {
    /// Pitch, rad.
    pub pitch_rad: S,
    /// Its rate, rad/s.
    pub rate_rad_s: S,
}

/// The joints of a side: what the rocker and bogie sensors see.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LinkAngles<S> {
    /// This side's rocker against the body. The differential makes the other side's its negative.
    pub rocker: Link<S>,
    /// This side's bogie against its rocker.
    pub bogie: Link<S>,
}

/// How the body moves, in its own axes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BodyMotion<S> {
    /// Velocity of the midpoint of the differential axis, m/s.
    pub velocity_m_s: Axes<S>,
    /// Rate of turn, rad/s, right-handed about each axis: nose-up is negative about y.
    pub turn_rad_s: Axes<S>,
}

impl<S: Scalar> LinkAngles<S> {
    /// Rates of rocker and bogie against inertial space while the body moves so, rad/s, nose-up.
    pub fn inertial_rates_rad_s(&self, body: &BodyMotion<S>) -> [S; 2] {
        let rocker = self.rocker.rate_rad_s - body.turn_rad_s.y;
        [rocker, rocker + self.bogie.rate_rad_s]
    }
}

/// Hubs and bogie pivot of a side in the body's axes, m from the midpoint of the differential axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SideLayout<S> {
    /// The hubs.
    pub hubs: PerAxle<Planar<S>>,
    /// The pivot of the bogie.
    pub bogie_pivot: Planar<S>,
    /// y of the side, m.
    pub y_m: S,
    /// Sine and cosine of the rocker's pitch against the body.
    pub rocker: (S, S),
    /// Sine and cosine of the bogie's pitch against the body.
    pub bogie: (S, S),
}

impl<S: Scalar> SideLayout<S> {
    /// The layout of a side with its joints at `angles`.
    pub fn new(rover: &Rover<S>, side: Side, angles: &LinkAngles<S>) -> Self {
        let suspension = &rover.suspension;
        let rocker = angles.rocker.pitch_rad.sin_cos();
        let bogie = (angles.rocker.pitch_rad + angles.bogie.pitch_rad).sin_cos();
        let bogie_pivot = suspension.bogie_pivot.turned(rocker);
        let y_m = suspension.y_m(side);
        let hubs = PerAxle {
            front: suspension.front_hub.turned(rocker),
            middle: bogie_pivot + suspension.middle_hub.turned(bogie),
            rear: bogie_pivot + suspension.rear_hub.turned(bogie),
        };
        Self { hubs, bogie_pivot, y_m, rocker, bogie }
    }

    /// Velocities of the hubs in the body's axes, m/s, in the plane of the side.
    pub fn hub_velocities_m_s(&self, motion: &BodyMotion<S>, angles: &LinkAngles<S>) -> PerAxle<Planar<S>> {
        let axis = self.axis_velocity_m_s(motion);
        let [rocker, bogie] = angles.inertial_rates_rad_s(motion);
        let pivot = axis + self.bogie_pivot.swept(rocker);
        PerAxle {
            front: axis + self.hubs.front.swept(rocker),
            middle: pivot + (self.hubs.middle - self.bogie_pivot).swept(bogie),
            rear: pivot + (self.hubs.rear - self.bogie_pivot).swept(bogie),
        }
    }

    /// Velocity of this side's end of the differential axis, m/s, in the plane of the side.
    pub fn axis_velocity_m_s(&self, motion: &BodyMotion<S>) -> Planar<S> {
        let BodyMotion { velocity_m_s: velocity, turn_rad_s: turn } = motion;
        Planar { x: velocity.x - turn.z * self.y_m, z: velocity.z + turn.x * self.y_m }
    }
}

#[cfg(test)]
mod tests {
    use super::{BodyMotion, Link, LinkAngles, SideLayout};
    use crate::rover::{Axes, Planar, Rover, Side};

    fn angles_at(time_s: f64) -> (LinkAngles<f64>, f64) {
        let link = |start: f64, rate: f64| Link { pitch_rad: start + rate * time_s, rate_rad_s: rate };
        (LinkAngles { rocker: link(0.1, 0.3), bogie: link(-0.2, 0.5) }, 0.2 + 0.4 * time_s)
    }

    /// Velocities against differences of positions over a short time, of a body that also pitches.
    #[test]
    fn velocities_are_the_rates_of_the_positions() {
        let rover = Rover::<f64>::assumed();
        let step = 1.0e-6;
        let place = |time_s: f64| {
            let (angles, pitch) = angles_at(time_s);
            let layout = SideLayout::new(&rover, Side::Left, &angles);
            layout.hubs.map(|hub| hub.turned(pitch.sin_cos()))
        };
        let (angles, pitch) = angles_at(0.0);
        let turn_rad_s = Axes { x: 0.0, y: -0.4, z: 0.0 };
        let motion = BodyMotion { velocity_m_s: Axes::default(), turn_rad_s };
        let velocities = SideLayout::new(&rover, Side::Left, &angles).hub_velocities_m_s(&motion, &angles);
        let (before, after) = (place(-step), place(step));
        for ((velocity, before), after) in
            velocities.as_array().into_iter().zip(before.as_array()).zip(after.as_array())
        {
            let expected = (*after - *before).scaled(0.5 / step);
            let found = velocity.turned(pitch.sin_cos());
            assert!((found - expected).length() < 1.0e-8, "{found:?} {expected:?}");
        }
    }

    #[test]
    fn a_left_turn_slows_the_left_wheels_and_a_roll_to_the_right_lifts_them() {
        let rover = Rover::<f64>::assumed();
        let layout = SideLayout::new(&rover, Side::Left, &LinkAngles::default());
        let turn_rad_s = Axes { x: 0.2, y: 0.0, z: 0.1 };
        let motion = BodyMotion { velocity_m_s: Axes::default(), turn_rad_s };
        let axis = layout.axis_velocity_m_s(&motion);
        assert_eq!(axis, Planar { x: -0.1 * 0.355, z: 0.2 * 0.355 });
    }
}
