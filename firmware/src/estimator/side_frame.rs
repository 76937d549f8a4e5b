//! What the estimators of a side see of a frame.

use super::sensor_gate::Repeats;
use crate::rover::{Axes, PerAxle, Planar};
use crate::scalar::Scalar;

/// What the sensors of a side, and those of the body, say in a frame; what cannot be used is absent.
#[derive(Debug, Clone, Copy)]
pub(super) struct SideFrame<S> {
    /// Encoders, rad/s.
    pub wheel_rate_rad_s: PerAxle<Option<S>>,
    /// Whether they say the same as in the frame before.
    pub wheel_rate_repeats: PerAxle<Repeats>,
    /// Drive torques, N·m.
    pub motor_torque_nm: PerAxle<Option<S>>,
    /// Load cells, N.
    pub load_cell_n: PerAxle<Option<S>>,
    /// Bogie against rocker, rad.
    pub bogie_angle_rad: Option<S>,
    /// This side's rocker against the body, rad.
    pub rocker_angle_rad: Option<S>,
    /// Velocity of the midpoint of the differential axis, m/s.
    pub velocity_m_s: Axes<Option<S>>,
    /// Gyro, rad/s.
    pub gyro_rad_s: Axes<Option<S>>,
    /// The share of its speed that the rover gained in the frame before, as its wheels tell it.
    pub rover_gained: S,
}

/// Of a side and the body, those whose silence makes estimates worse: encoders, drive torques and cells of the three wheels, front to rear,
/// bogie, rocker and the velocimeter.
pub(super) const SENSORS: usize = 12;

impl<S: Scalar> SideFrame<S> {
    /// One for each sensor that cannot be used, in the order of [`SENSORS`]; with what of the velocity can be.
    pub fn silent(&self, velocity_m_s: &Planar<Option<S>>) -> [S; SENSORS] {
        let Self { wheel_rate_rad_s: rates, motor_torque_nm: torques, load_cell_n: cells, .. } = self;
        let of_wheels = [rates, torques, cells].map(|sensors| [sensors.front, sensors.middle, sensors.rear]);
        let of_side = [self.bogie_angle_rad, self.rocker_angle_rad, velocity_m_s.x.and(velocity_m_s.z)];
        let mut silent = [S::zero(); SENSORS];
        let readings = of_wheels.as_flattened().iter().chain(&of_side);
        for (silent, _) in silent.iter_mut().zip(readings).filter(|(_, reading)| reading.is_none()) {
            *silent = S::one();
        }
        silent
    }
}
