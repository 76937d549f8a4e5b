//! Which sensors gave trouble, and what kind.

use kapvik_firmware::estimator::{Axis, EstimatorHealth, Sensor, SensorHealth};
use kapvik_firmware::rover::{Axle, Side};

/// A sensor whose readings were not all used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SensorTrouble {
    /// Its column in files of frames.
    pub sensor: String,
    /// How often for what reason; reasons that never occurred are left out.
    pub reasons: Vec<(&'static str, u16)>,
    /// It was out of use at the end.
    pub dropped: bool,
}

/// Why a reading is not used.
pub const REASONS: [&str; 6] = ["missing", "not finite", "out of range", "stuck", "surprising", "on probation"];

impl SensorTrouble {
    /// How often that was the reason; none where it never was.
    pub fn count(&self, reason: &str) -> Option<u16> {
        self.reasons.iter().find(|(name, _)| *name == reason).map(|(_, count)| *count)
    }
}

/// Every sensor that gave trouble.
pub fn troubles(health: &EstimatorHealth) -> Vec<SensorTrouble> {
    let named = health.sensors.zip_map(Sensor::all(), |health, sensor| (sensor, health));
    named
        .iter()
        .filter(|(_, health)| *health != SensorHealth::default())
        .map(|(sensor, health)| SensorTrouble {
            sensor: sensor_name(*sensor),
            reasons: reasons(health),
            dropped: health.dropped,
        })
        .collect()
}

fn reasons(health: &SensorHealth) -> Vec<(&'static str, u16)> {
    let SensorHealth { missing, not_finite, out_of_range, stuck, surprising, on_probation, dropped: _ } = *health;
    let counts = [missing, not_finite, out_of_range, stuck, surprising, on_probation];
    REASONS.into_iter().zip(counts).filter(|(_, count)| *count > 0).collect()
}

/// The column of a sensor in files of frames.
pub fn sensor_name(sensor: Sensor) -> String {
    match sensor {
        Sensor::WheelRate(side, axle) => format!("wheel_rate_{}_rad_s", wheel(side, axle)),
        Sensor::MotorTorque(side, axle) => format!("motor_torque_{}_nm", wheel(side, axle)),
        Sensor::LoadCell(side, axle) => format!("load_cell_{}_n", wheel(side, axle)),
        Sensor::BogieAngle(side) => format!("bogie_angle_{}_rad", letter(side)),
        Sensor::RockerAngle => "rocker_angle_rad".to_owned(),
        Sensor::Accel(axis) => format!("accel_{}_m_s2", axis_letter(axis)),
        Sensor::Gyro(axis) => format!("gyro_{}_rad_s", axis_letter(axis)),
        Sensor::Velocity(axis) => format!("velocity_{}_m_s", axis_letter(axis)),
    }
}

fn wheel(side: Side, axle: Axle) -> String {
    let axle = match axle {
        Axle::Front => 'f',
        Axle::Middle => 'm',
        Axle::Rear => 'r',
    };
    format!("{axle}{}", letter(side))
}

fn letter(side: Side) -> char {
    match side {
        Side::Left => 'l',
        Side::Right => 'r',
    }
}

fn axis_letter(axis: Axis) -> char {
    match axis {
        Axis::X => 'x',
        Axis::Y => 'y',
        Axis::Z => 'z',
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::sensor_channels;

    #[test]
    fn sensors_have_the_names_of_their_columns() {
        let mut ours: Vec<String> = Sensor::all().iter().map(|sensor| sensor_name(*sensor)).collect();
        let mut columns = sensor_channels::names();
        ours.sort();
        columns.sort();
        assert_eq!(ours, columns);
    }

    #[test]
    fn only_trouble_is_told() {
        let mut health = EstimatorHealth { frames: 9, ..EstimatorHealth::NOTHING };
        assert_eq!(troubles(&health), []);
        health.sensors.load_cell.right.middle.stuck = 4;
        health.sensors.load_cell.right.middle.dropped = true;
        let trouble = SensorTrouble { sensor: "load_cell_mr_n".to_owned(), reasons: vec![("stuck", 4)], dropped: true };
        assert_eq!(troubles(&health), [trouble]);
    }
}
