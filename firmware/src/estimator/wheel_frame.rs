//! How the hubs of a side move, as filter 1 of each wheel is told.

use super::contact_angle::SideReadings;
use super::load_shift::HubShift;
use super::side_estimator::SideEstimator;
use crate::rover::{PerAxle, Planar};
use crate::scalar::Scalar;

/// How the hub of a wheel moves in a frame.
pub(super) struct WheelFrame<S> {
    /// How fast its link turns, rad/s.
    pub link_rate_rad_s: S,
    /// Speed of the hub along its contact, m/s.
    pub hub_speed_m_s: S,
    /// The same by what the velocimeter says, m/s.
    pub measured_hub_speed_m_s: Option<S>,
    /// One standard deviation of that, m/s.
    pub hub_speed_std_m_s: S,
}

impl<S: Scalar> SideEstimator<S> {
    /// Speeds of the hubs along their contacts: the measured velocity of the axis, and what the joints add to it.
    pub(super) fn wheel_frames(&self, readings: &SideReadings<S>, body_pitch: (S, S)) -> PerAxle<WheelFrame<S>> {
        let motion = &self.motion;
        // Where the velocimeter does not say how fast it rises, what the links tell of that.
        let Planar { x, z } = readings.axis_velocity_m_s;
        let z = z.unwrap_or(motion.axis_velocity_m_s.turned_back(body_pitch).z);
        let measured = x.map(|x| Planar { x, z }.turned(body_pitch));
        let velocity_variance = readings.velocity_std_m_s.x * readings.velocity_std_m_s.x;
        let variances = self.angles.hub_speed_variances(self.speed_m_s());
        let shifts = self.angles.load_shift().hubs(&self.rover.suspension);
        let frame = |hub: Planar<S>, tangent: Planar<S>, link_rate_rad_s: S, variance: S, shift: HubShift<S>| {
            let hub_speed_m_s = hub.dot(tangent) + shift.faster_m_s;
            let correction = measured.map(|axis| (axis - motion.axis_velocity_m_s).dot(tangent));
            WheelFrame {
                link_rate_rad_s,
                hub_speed_m_s,
                measured_hub_speed_m_s: correction.map(|correction| hub_speed_m_s + correction),
                hub_speed_std_m_s: (velocity_variance + variance + shift.std_m_s * shift.std_m_s).sqrt(),
            }
        };
        let (hubs, tangents) = (&motion.hub_velocities_m_s, &motion.tangents);
        let (of_rocker, of_bogie) = (motion.rocker_rate_rad_s, motion.bogie_rate_rad_s);
        PerAxle {
            front: frame(hubs.front, tangents.front, of_rocker, variances.front, shifts.front),
            middle: frame(hubs.middle, tangents.middle, of_bogie, variances.middle, shifts.middle),
            rear: frame(hubs.rear, tangents.rear, of_bogie, variances.rear, shifts.rear),
        }
    }
}
