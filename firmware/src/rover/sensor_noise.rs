//! How noisy the rover's sensors are.

use serde::{Deserialize, Serialize};

use crate::scalar::Scalar;

/// One standard deviation of each kind of sensor in one frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SensorNoise<S> {
    /// Of a wheel's encoder, rad/s.
    pub wheel_rate_rad_s: S,
    /// Of a drive's torque at the wheel axle, N·m.
    pub motor_torque_nm: S,
    /// Of a load cell, N.
    pub load_cell_n: S,
    /// Of a rocker or bogie angle, rad.
    pub angle_rad: S,
    /// Of an axis of the accelerometer, m/s².
    pub accel_m_s2: S,
    /// Of an axis of the gyro, rad/s.
    pub gyro_rad_s: S,
    /// Of an axis of the visual velocimeter, m/s.
    pub velocity_m_s: S,
}

impl<S: Scalar> SensorNoise<S> {
    /// The set K0: assumed, since nothing on Kapvik's sensors was published.
    pub fn assumed() -> Self {
        Self {
            wheel_rate_rad_s: S::constant(0.002),
            motor_torque_nm: S::constant(0.05),
            load_cell_n: S::constant(0.5),
            angle_rad: S::constant(0.001),
            accel_m_s2: S::constant(0.02),
            gyro_rad_s: S::constant(0.001),
            velocity_m_s: S::constant(0.0005),
        }
    }

    /// Every standard deviation is a number above zero.
    pub fn is_valid(&self) -> bool {
        let all = [
            self.wheel_rate_rad_s,
            self.motor_torque_nm,
            self.load_cell_n,
            self.angle_rad,
            self.accel_m_s2,
            self.gyro_rad_s,
            self.velocity_m_s,
        ];
        all.iter().all(|std| *std > S::zero()) && all.iter().fold(S::zero(), |sum, std| sum + *std).is_finite()
    }
}

impl<S> SensorNoise<S> {
    /// The same noise in another scalar.
    pub fn map<T>(self, convert: impl Fn(S) -> T) -> SensorNoise<T> {
        SensorNoise {
            wheel_rate_rad_s: convert(self.wheel_rate_rad_s),
            motor_torque_nm: convert(self.motor_torque_nm),
            load_cell_n: convert(self.load_cell_n),
            angle_rad: convert(self.angle_rad),
            accel_m_s2: convert(self.accel_m_s2),
            gyro_rad_s: convert(self.gyro_rad_s),
            velocity_m_s: convert(self.velocity_m_s),
        }
    }
}
