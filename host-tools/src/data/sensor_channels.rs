//! The columns of a sensor frame: their names in the files, and where each stands in [`SensorFrame`].

use kapvik_firmware::estimator::{Axis, Sensor};
use kapvik_firmware::rover::{Axes, Axle, PerAxle, PerSide, SensorNoise, Side};
use kapvik_firmware::sensor_frame::{SensorFrame, WheelSensors};

/// The wheels as the files name them, in the order of the flight library.
pub const WHEEL_NAMES: [&str; 6] = ["fl", "ml", "rl", "fr", "mr", "rr"];

/// The sensors, in the order of [`values`].
pub fn sensors() -> Vec<Sensor> {
    let of_wheel = [Sensor::WheelRate, Sensor::MotorTorque, Sensor::LoadCell];
    let wheels = Side::ALL.map(|side| Axle::ALL.map(|axle| of_wheel.map(|sensor| sensor(side, axle))));
    let joints = [Sensor::BogieAngle(Side::Left), Sensor::BogieAngle(Side::Right), Sensor::RockerAngle];
    let body = [Sensor::Accel, Sensor::Gyro, Sensor::Velocity].map(|sensor| [Axis::X, Axis::Y, Axis::Z].map(sensor));
    wheels.iter_wheels().flatten().chain(&joints).chain(body.as_flattened()).copied().collect()
}

/// The names of the columns, in the same order.
pub fn names() -> Vec<String> {
    sensors().into_iter().map(sensor_name).collect()
}

/// The key of a sensor's noise in a rover file's `[noise]`.
pub fn noise_key(sensor: Sensor) -> &'static str {
    match sensor {
        Sensor::WheelRate(..) => "wheel_rate_rad_s",
        Sensor::MotorTorque(..) => "motor_torque_nm",
        Sensor::LoadCell(..) => "load_cell_n",
        Sensor::BogieAngle(_) | Sensor::RockerAngle => "angle_rad",
        Sensor::Accel(_) => "accel_m_s2",
        Sensor::Gyro(_) => "gyro_rad_s",
        Sensor::Velocity(_) => "velocity_m_s",
    }
}

/// The name of a sensor's column.
pub fn sensor_name(sensor: Sensor) -> String {
    match sensor {
        Sensor::WheelRate(side, axle) => format!("wheel_rate_{}_rad_s", wheel(side, axle)),
        Sensor::MotorTorque(side, axle) => format!("motor_torque_{}_nm", wheel(side, axle)),
        Sensor::LoadCell(side, axle) => format!("load_cell_{}_n", wheel(side, axle)),
        Sensor::BogieAngle(Side::Left) => "bogie_angle_l_rad".to_owned(),
        Sensor::BogieAngle(Side::Right) => "bogie_angle_r_rad".to_owned(),
        Sensor::RockerAngle => "rocker_angle_rad".to_owned(),
        Sensor::Accel(axis) => format!("accel_{}_m_s2", letter(axis)),
        Sensor::Gyro(axis) => format!("gyro_{}_rad_s", letter(axis)),
        Sensor::Velocity(axis) => format!("velocity_{}_m_s", letter(axis)),
    }
}

fn wheel(side: Side, axle: Axle) -> &'static str {
    let [left @ .., front, middle, rear] = WHEEL_NAMES;
    let right = [front, middle, rear];
    PerSide { left, right }.map(PerAxle::from_array).of_wheel(side, axle)
}

fn letter(axis: Axis) -> char {
    match axis {
        Axis::X => 'x',
        Axis::Y => 'y',
        Axis::Z => 'z',
    }
}

/// The values of a frame, in the order of [`names`].
pub fn values(frame: &SensorFrame) -> Vec<Option<f32>> {
    let mut copy = *frame;
    values_mut(&mut copy).map(|value| *value).collect()
}

/// The values of a frame, to be changed, in the order of [`names`].
pub fn values_mut(frame: &mut SensorFrame) -> impl Iterator<Item = &mut Option<f32>> {
    let SensorFrame {
        time_us: _,
        wheels,
        bogie_angle_rad: PerSide { left, right },
        rocker_angle_rad,
        accel_m_s2,
        gyro_rad_s,
        velocity_m_s,
    } = frame;
    wheels
        .iter_wheels_mut()
        .flat_map(|WheelSensors { rate_rad_s, motor_torque_nm, load_cell_n }| {
            [rate_rad_s, motor_torque_nm, load_cell_n]
        })
        .chain([left, right, rocker_angle_rad])
        .chain([accel_m_s2, gyro_rad_s, velocity_m_s].into_iter().flat_map(|Axes { x, y, z }| [x, y, z]))
}

/// One standard deviation of each sensor, in its place.
pub fn standard_deviations(noise: &SensorNoise<f32>) -> SensorFrame {
    let wheel = WheelSensors {
        rate_rad_s: Some(noise.wheel_rate_rad_s),
        motor_torque_nm: Some(noise.motor_torque_nm),
        load_cell_n: Some(noise.load_cell_n),
    };
    let axes = |std: f32| Axes { x: Some(std), y: Some(std), z: Some(std) };
    SensorFrame {
        time_us: 0,
        wheels: PerSide::both(PerAxle::all(wheel)),
        bogie_angle_rad: PerSide::both(Some(noise.angle_rad)),
        rocker_angle_rad: Some(noise.angle_rad),
        accel_m_s2: axes(noise.accel_m_s2),
        gyro_rad_s: axes(noise.gyro_rad_s),
        velocity_m_s: axes(noise.velocity_m_s),
    }
}

#[cfg(test)]
mod tests {
    use super::{names, values, values_mut};
    use kapvik_firmware::sensor_frame::SensorFrame;

    #[test]
    fn names_and_values_stand_in_the_same_order() {
        let mut frame = SensorFrame::default();
        for (place, value) in values_mut(&mut frame).enumerate() {
            *value = Some(place as f32);
        }
        let place = |name: &str| names().iter().position(|other| other == name).map(|place| place as f32);
        assert_eq!(names().len(), values(&frame).len());
        assert_eq!(frame.wheels.right.middle.load_cell_n, place("load_cell_mr_n"));
        assert_eq!(frame.wheels.left.rear.motor_torque_nm, place("motor_torque_rl_nm"));
        assert_eq!(frame.bogie_angle_rad.right, place("bogie_angle_r_rad"));
        assert_eq!(frame.rocker_angle_rad, place("rocker_angle_rad"));
        assert_eq!(frame.gyro_rad_s.z, place("gyro_z_rad_s"));
        assert_eq!(frame.velocity_m_s.x, place("velocity_x_m_s"));
        assert_eq!(values(&frame).last().copied().flatten(), place("velocity_z_m_s"));
    }
}
