//! How a side moves when its three wheels roll along their contacts.
//!
//! A hub moves along the terrain under it. Two hubs on a rigid link have the same speed along the link; what they have
//! across it turns the link (the construction behind Iagnemma and Dubowsky's contact-angle estimate). So one speed, three
//! contact angles and the links' pitches tell the motion of the whole side. Sinking, which is slow, is left out: it passes
//! for a contact angle.

use super::{PerAxle, Planar, Rover, Suspension};
use crate::scalar::Scalar;

/// The shape of a side, as its motion depends on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingSide<S> {
    /// From the rear hub to the middle hub, in the bogie's coordinates.
    bogie: Bar<S>,
    /// From the rear hub to the pivot, in the bogie's coordinates.
    pivot_from_rear: Planar<S>,
    /// From the pivot to the front hub, in the rocker's coordinates.
    rocker: Bar<S>,
    /// From the pivot to the differential axis, in the rocker's coordinates.
    axis_from_pivot: Planar<S>,
}

/// A rigid link between two points that move.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Bar<S> {
    direction: Planar<S>,
    inverse_length: S,
}

/// Where a side stands and rolls: angles in the plane of the side against its level line, rad, nose-up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingState<S> {
    /// Speed of the bogie along the line through its hubs, m/s.
    pub speed_m_s: S,
    /// Contact angles.
    pub contact_angles_rad: PerAxle<S>,
    /// Pitch of the rocker.
    pub rocker_pitch_rad: S,
    /// Pitch of the bogie.
    pub bogie_pitch_rad: S,
}

/// How it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingMotion<S> {
    /// Rate of the rocker's pitch, rad/s.
    pub rocker_rate_rad_s: S,
    /// Rate of the bogie's pitch, rad/s.
    pub bogie_rate_rad_s: S,
    /// Velocity of this side's end of the differential axis, m/s.
    pub axis_velocity_m_s: Planar<S>,
    /// Velocities of the hubs, m/s.
    pub hub_velocities_m_s: PerAxle<Planar<S>>,
    /// The directions along the terrain under the hubs.
    pub tangents: PerAxle<Planar<S>>,
}

/// The least cosine between a link and the path of its hub: a hub that moves nearly across its link cannot be told from
/// one that does not move along it.
const LEAST_COSINE: f64 = 0.2;

impl<S: Scalar> Bar<S> {
    fn between(from: Planar<S>, to: Planar<S>) -> Self {
        let bar = to - from;
        let inverse_length = S::one() / bar.length();
        Self { direction: bar.scaled(inverse_length), inverse_length }
    }
}

impl<S: Scalar> RollingSide<S> {
    /// The shape of either side of a rover that passes [`Rover::check`].
    pub fn new(rover: &Rover<S>) -> Self {
        let suspension = &rover.suspension;
        let origin = Planar { x: S::zero(), z: S::zero() };
        Self {
            bogie: Bar::between(suspension.rear_hub, suspension.middle_hub),
            pivot_from_rear: origin - suspension.rear_hub,
            rocker: Bar::between(suspension.bogie_pivot, suspension.front_hub),
            axis_from_pivot: origin - suspension.bogie_pivot,
        }
    }

    /// The motion of a side that rolls.
    pub fn motion(&self, state: &RollingState<S>) -> RollingMotion<S> {
        let rocker = state.rocker_pitch_rad.sin_cos();
        let bogie = state.bogie_pitch_rad.sin_cos();
        let tangents = state.contact_angles_rad.map(|angle| Planar::direction(angle.sin_cos()));
        let along = self.bogie.direction.turned(bogie);
        let middle = along_path(along, state.speed_m_s, tangents.middle);
        let rear = along_path(along, state.speed_m_s, tangents.rear);
        let bogie_rate_rad_s = across(along).dot(middle - rear) * self.bogie.inverse_length;
        let pivot = rear + self.pivot_from_rear.turned(bogie).swept(bogie_rate_rad_s);
        let along = self.rocker.direction.turned(rocker);
        let front = along_path(along, pivot.dot(along), tangents.front);
        let rocker_rate_rad_s = across(along).dot(front - pivot) * self.rocker.inverse_length;
        RollingMotion {
            rocker_rate_rad_s,
            bogie_rate_rad_s,
            axis_velocity_m_s: pivot + self.axis_from_pivot.turned(rocker).swept(rocker_rate_rad_s),
            hub_velocities_m_s: PerAxle { front, middle, rear },
            tangents,
        }
    }
}

/// How much faster than the differential axis each hub goes along its contact, in parts of the speed of the side for each
/// radian of the front, middle and rear contact angle: to first order, of links near the level.
///
/// A contact that is steeper than the others turns its link, and the hubs hang below what the link turns about.
pub fn hub_speed_slopes<S: Scalar>(rover: &Rover<S>) -> PerAxle<PerAxle<S>> {
    let Suspension { front_hub, bogie_pivot, middle_hub, rear_hub, .. } = rover.suspension;
    let bogie_length = middle_hub.x - rear_hub.x;
    let rocker_length = front_hub.x - bogie_pivot.x;
    // The pivot's path is between those of the bogie's hubs.
    let of_middle = -rear_hub.x / bogie_length;
    let slopes = |below_axis: S, below_pivot: S| {
        let (by_rocker, by_bogie) = (below_axis / rocker_length, below_pivot / bogie_length);
        PerAxle {
            front: by_rocker,
            middle: by_bogie - of_middle * by_rocker,
            rear: -by_bogie - (S::one() - of_middle) * by_rocker,
        }
    };
    PerAxle {
        front: slopes(-front_hub.z, S::zero()),
        middle: slopes(-bogie_pivot.z, -middle_hub.z),
        rear: slopes(-bogie_pivot.z, -rear_hub.z),
    }
}

/// The direction square to `along`, on its nose-up side.
fn across<S: Scalar>(along: Planar<S>) -> Planar<S> {
    along.swept(S::one())
}

/// The velocity of a hub that moves along `tangent` with the given speed along its link.
fn along_path<S: Scalar>(link: Planar<S>, speed_m_s: S, tangent: Planar<S>) -> Planar<S> {
    tangent.scaled(speed_m_s / tangent.dot(link).max(S::constant(LEAST_COSINE)))
}

#[cfg(test)]
mod tests {
    use super::{RollingSide, RollingState, hub_speed_slopes};
    use crate::rover::{Axes, BodyMotion, Link, LinkAngles, PerAxle, Rover, Side, SideLayout};

    /// The kinematics of the joints, given the rates found here, must move each hub along its contact.
    #[test]
    fn the_hubs_move_along_their_contacts_as_the_joints_turn() {
        let rover = Rover::<f64>::assumed();
        let contact_angles_rad = PerAxle::from_array([0.3, -0.2, 0.1]);
        let state =
            RollingState { speed_m_s: 0.02, contact_angles_rad, rocker_pitch_rad: 0.15, bogie_pitch_rad: -0.08 };
        let motion = RollingSide::new(&rover).motion(&state);
        // A body that is level and does not turn: the joints' pitches are the links'.
        let angles = LinkAngles {
            rocker: Link { pitch_rad: 0.15, rate_rad_s: motion.rocker_rate_rad_s },
            bogie: Link { pitch_rad: -0.23, rate_rad_s: motion.bogie_rate_rad_s - motion.rocker_rate_rad_s },
        };
        let velocity_m_s = Axes { x: motion.axis_velocity_m_s.x, y: 0.0, z: motion.axis_velocity_m_s.z };
        let body = BodyMotion { velocity_m_s, turn_rad_s: Axes::default() };
        let velocities = SideLayout::new(&rover, Side::Right, &angles).hub_velocities_m_s(&body, &angles);
        let hubs = velocities.zip(motion.hub_velocities_m_s).zip(contact_angles_rad);
        for ((by_joints, found), angle) in hubs.as_array().into_iter() {
            assert!((*by_joints - *found).length() < 1.0e-12, "{by_joints:?} {found:?}");
            assert!((by_joints.z / by_joints.x - angle.tan()).abs() < 1.0e-12);
        }
    }

    /// Small changes of the contact angles of a level side, one at a time, must change the speeds as the slopes say.
    #[test]
    fn a_steeper_contact_changes_the_speeds_of_the_hubs_by_its_slope() {
        let rover = Rover::<f64>::assumed();
        let (side, step, speed_m_s) = (RollingSide::new(&rover), 1.0e-6, 0.02);
        let relative_speeds = |angles: [f64; 3]| {
            let contact_angles_rad = PerAxle::from_array(angles);
            let state = RollingState { speed_m_s, contact_angles_rad, rocker_pitch_rad: 0.0, bogie_pitch_rad: 0.0 };
            let motion = side.motion(&state);
            let along = |(hub, tangent): (crate::rover::Planar<f64>, _)| (hub - motion.axis_velocity_m_s).dot(tangent);
            motion.hub_velocities_m_s.zip(motion.tangents).map(along).into_array()
        };
        let slopes = hub_speed_slopes(&rover).map(PerAxle::into_array).into_array();
        for contact in 0..3 {
            let [mut ahead, mut behind] = [[0.0; 3]; 2];
            (ahead[contact], behind[contact]) = (step, -step);
            let (ahead, behind) = (relative_speeds(ahead), relative_speeds(behind));
            for hub in 0..3 {
                let slope = (ahead[hub] - behind[hub]) / (2.0 * step * speed_m_s);
                assert!((slope - slopes[hub][contact]).abs() < 1.0e-6, "{hub} {contact}: {slope} {slopes:?}");
            }
        }
    }
}
