//! What the rover's sensors say at one instant.

use serde::{Deserialize, Serialize};

use crate::rover::{Axes, PerSide, PerWheel};

/// The sensors of one wheel. A value may be missing: that sensor gave nothing.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct WheelSensors {
    /// Encoder: rate of the wheel against its link, rad/s, positive forward.
    pub rate_rad_s: Option<f32>,
    /// Torque of the drive at the wheel axle, N·m.
    pub motor_torque_nm: Option<f32>,
    /// Load cell: force along the hub bracket's axis, square to its rocker or bogie, N, positive in compression.
    pub load_cell_n: Option<f32>,
}

/// One frame of the sensors.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SensorFrame {
    /// Time, µs: whole numbers, so that long drives lose no precision.
    pub time_us: u64,
    /// The wheels.
    pub wheels: PerWheel<WheelSensors>,
    /// Each bogie against its rocker, rad, nose-up.
    pub bogie_angle_rad: PerSide<Option<f32>>,
    /// Left rocker against the body, rad, nose-up; the right one is its negative.
    pub rocker_angle_rad: Option<f32>,
    /// Specific force in the body's axes, m/s²: (0, 0, +g) at rest on the level.
    pub accel_m_s2: Axes<Option<f32>>,
    /// Rate of turn about the body's axes, rad/s.
    pub gyro_rad_s: Axes<Option<f32>>,
    /// Visual velocimeter: velocity of the midpoint of the differential axis in the body's axes, m/s.
    pub velocity_m_s: Axes<Option<f32>>,
}
