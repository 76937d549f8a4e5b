//! Which sensor: for counters, logs and tables that name one.

use crate::rover::{Axes, Axle, Side};

use super::PerSensor;

/// An axis of the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Axis {
    /// Forward.
    X,
    /// Left.
    Y,
    /// Up.
    Z,
}

/// One of the rover's sensors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Sensor {
    /// Encoder of a wheel.
    WheelRate(Side, Axle),
    /// Drive torque of a wheel.
    MotorTorque(Side, Axle),
    /// Load cell of a wheel.
    LoadCell(Side, Axle),
    /// Angle of a bogie.
    BogieAngle(Side),
    /// Angle of the rockers.
    RockerAngle,
    /// Accelerometer.
    Accel(Axis),
    /// Gyro.
    Gyro(Axis),
    /// Visual velocimeter.
    Velocity(Axis),
}

impl Sensor {
    /// Every sensor in its place.
    pub fn all() -> PerSensor<Self> {
        let on_wheels = |name: fn(Side, Axle) -> Self| Side::ALL.map(|side| Axle::ALL.map(|axle| name(side, axle)));
        let on_axes = |name: fn(Axis) -> Self| Axes { x: name(Axis::X), y: name(Axis::Y), z: name(Axis::Z) };
        PerSensor {
            wheel_rate: on_wheels(Self::WheelRate),
            motor_torque: on_wheels(Self::MotorTorque),
            load_cell: on_wheels(Self::LoadCell),
            bogie_angle: Side::ALL.map(Self::BogieAngle),
            rocker_angle: Self::RockerAngle,
            accel: on_axes(Self::Accel),
            gyro: on_axes(Self::Gyro),
            velocity: on_axes(Self::Velocity),
        }
    }
}
