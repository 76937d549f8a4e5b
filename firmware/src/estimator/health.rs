//! How the sensors and filters do.

use serde::{Deserialize, Serialize};

use crate::rover::{Axes, PerAxle, PerSide, PerWheel};
use crate::sensor_frame::SensorFrame;

/// One value for each sensor of the rover.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct PerSensor<T> {
    /// Encoders.
    pub wheel_rate: PerWheel<T>,
    /// Drive torques.
    pub motor_torque: PerWheel<T>,
    /// Load cells.
    pub load_cell: PerWheel<T>,
    /// Bogie angles.
    pub bogie_angle: PerSide<T>,
    /// Rocker angle.
    pub rocker_angle: T,
    /// Accelerometer.
    pub accel: Axes<T>,
    /// Gyro.
    pub gyro: Axes<T>,
    /// Visual velocimeter.
    pub velocity: Axes<T>,
}

impl<T> PerSensor<T> {
    /// Each value converted.
    pub fn map<V>(self, mut convert: impl FnMut(T) -> V) -> PerSensor<V> {
        self.zip_map(PerSensor::default(), |value, ()| convert(value))
    }

    /// Each value with its partner converted.
    pub fn zip_map<U, V>(self, other: PerSensor<U>, mut convert: impl FnMut(T, U) -> V) -> PerSensor<V> {
        let mut wheels = |one: PerWheel<T>, two: PerWheel<U>| one.zip_wheels(two).map_wheels(|(a, b)| convert(a, b));
        let wheel_rate = wheels(self.wheel_rate, other.wheel_rate);
        let motor_torque = wheels(self.motor_torque, other.motor_torque);
        let load_cell = wheels(self.load_cell, other.load_cell);
        let bogie_angle = self.bogie_angle.zip(other.bogie_angle).map(|(a, b)| convert(a, b));
        let rocker_angle = convert(self.rocker_angle, other.rocker_angle);
        let mut axes = |one: Axes<T>, two: Axes<U>| Axes {
            x: convert(one.x, two.x),
            y: convert(one.y, two.y),
            z: convert(one.z, two.z),
        };
        PerSensor {
            wheel_rate,
            motor_torque,
            load_cell,
            bogie_angle,
            rocker_angle,
            accel: axes(self.accel, other.accel),
            gyro: axes(self.gyro, other.gyro),
            velocity: axes(self.velocity, other.velocity),
        }
    }

    /// References to the values.
    pub fn as_ref(&self) -> PerSensor<&T> {
        PerSensor {
            wheel_rate: self.wheel_rate.as_ref().map(|side| side.as_ref()),
            motor_torque: self.motor_torque.as_ref().map(|side| side.as_ref()),
            load_cell: self.load_cell.as_ref().map(|side| side.as_ref()),
            bogie_angle: self.bogie_angle.as_ref(),
            rocker_angle: &self.rocker_angle,
            accel: self.accel.as_ref(),
            gyro: self.gyro.as_ref(),
            velocity: self.velocity.as_ref(),
        }
    }

    /// References to the values, to change them.
    pub fn as_mut(&mut self) -> PerSensor<&mut T> {
        PerSensor {
            wheel_rate: self.wheel_rate.as_mut().map(PerAxle::as_mut),
            motor_torque: self.motor_torque.as_mut().map(PerAxle::as_mut),
            load_cell: self.load_cell.as_mut().map(PerAxle::as_mut),
            bogie_angle: self.bogie_angle.as_mut(),
            rocker_angle: &mut self.rocker_angle,
            accel: self.accel.as_mut(),
            gyro: self.gyro.as_mut(),
            velocity: self.velocity.as_mut(),
        }
    }

    /// All values, in the order of the fields.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        self.wheel_rate
            .iter_wheels()
            .chain(self.motor_torque.iter_wheels())
            .chain(self.load_cell.iter_wheels())
            .chain(self.bogie_angle.as_array())
            .chain([&self.rocker_angle])
            .chain(self.accel.as_array())
            .chain(self.gyro.as_array())
            .chain(self.velocity.as_array())
    }
}

impl SensorFrame {
    /// The readings, sensor by sensor.
    pub fn readings(&self) -> PerSensor<Option<f32>> {
        PerSensor {
            wheel_rate: self.wheels.map_wheels(|wheel| wheel.rate_rad_s),
            motor_torque: self.wheels.map_wheels(|wheel| wheel.motor_torque_nm),
            load_cell: self.wheels.map_wheels(|wheel| wheel.load_cell_n),
            bogie_angle: self.bogie_angle_rad,
            rocker_angle: self.rocker_angle_rad,
            accel: self.accel_m_s2,
            gyro: self.gyro_rad_s,
            velocity: self.velocity_m_s,
        }
    }
}

/// How often one sensor's readings were not used, by reason. Counts stop at their greatest value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct SensorHealth {
    /// It gave nothing.
    #[serde(with = "crate::outlined")]
    pub missing: u16,
    /// NaN or infinite.
    #[serde(with = "crate::outlined")]
    pub not_finite: u16,
    /// Farther out than the rover can be.
    #[serde(with = "crate::outlined")]
    pub out_of_range: u16,
    /// The same bits over and over.
    #[serde(with = "crate::outlined")]
    pub stuck: u16,
    /// Too far from what the filter expected.
    #[serde(with = "crate::outlined")]
    pub surprising: u16,
    /// Good readings that were left out while the sensor was on probation.
    #[serde(with = "crate::outlined")]
    pub on_probation: u16,
    /// It was bad for so long that it is out of use until it has proved itself.
    pub dropped: bool,
}

/// How the estimator does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct EstimatorHealth {
    /// Frames taken.
    #[serde(with = "crate::outlined")]
    pub frames: u32,
    /// Frames that repeated the time of the one before, and were left out.
    #[serde(with = "crate::outlined")]
    pub repeated_frames: u32,
    /// Frames from before the one before, which were left out, but for those with which the filters started anew.
    #[serde(with = "crate::outlined")]
    pub backward_frames: u32,
    /// Frames with which the filters started anew: after a long gap, or after a clock was set back.
    #[serde(with = "crate::outlined")]
    pub gaps: u32,
    /// Failed factorisations: a filter was reset to its stated floor.
    #[serde(with = "crate::outlined")]
    pub filter_resets: u32,
    /// How often a filter gave up what it believed because measurements contradicted it for long.
    #[serde(with = "crate::outlined")]
    pub relearned: u32,
    /// The sensors.
    pub sensors: PerSensor<SensorHealth>,
}

impl EstimatorHealth {
    /// Before the first frame. A constant, for it is all zeros: to set each count by itself takes flash.
    pub const NOTHING: Self = {
        const SENSOR: SensorHealth = SensorHealth {
            missing: 0,
            not_finite: 0,
            out_of_range: 0,
            stuck: 0,
            surprising: 0,
            on_probation: 0,
            dropped: false,
        };
        const SIDE: PerAxle<SensorHealth> = PerAxle { front: SENSOR, middle: SENSOR, rear: SENSOR };
        const WHEELS: PerWheel<SensorHealth> = PerSide { left: SIDE, right: SIDE };
        const AXES: Axes<SensorHealth> = Axes { x: SENSOR, y: SENSOR, z: SENSOR };
        Self {
            frames: 0,
            repeated_frames: 0,
            backward_frames: 0,
            gaps: 0,
            filter_resets: 0,
            relearned: 0,
            sensors: PerSensor {
                wheel_rate: WHEELS,
                motor_torque: WHEELS,
                load_cell: WHEELS,
                bogie_angle: PerSide { left: SENSOR, right: SENSOR },
                rocker_angle: SENSOR,
                accel: AXES,
                gyro: AXES,
                velocity: AXES,
            },
        }
    };
}
