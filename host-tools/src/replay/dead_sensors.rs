//! Whether sensors say exactly zero while the rover drives: a logger's way of writing one that is not there.

use kapvik_firmware::estimator::{Axis, Sensor};
use kapvik_firmware::rover::{PerSide, Rover};
use kapvik_firmware::sensor_frame::SensorFrame;

use super::raw_sensors::{LEAST_READINGS, NEARLY_ALL, drives};
use crate::data::sensor_channels::{sensor_name, sensors, values};

/// Whether a sensor may say exact zeros: encoders of wheels that are blocked, and what goes sideways where that is left out.
fn may_be_zero(sensor: Sensor) -> bool {
    matches!(sensor, Sensor::WheelRate(..) | Sensor::Gyro(Axis::X | Axis::Z))
        || matches!(sensor, Sensor::Velocity(Axis::Y) | Sensor::Accel(Axis::Y))
}

/// Whether it says something else wherever sensors have noise, on a plane, too.
fn is_noisy(sensor: Sensor) -> bool {
    is_joint(sensor) || matches!(sensor, Sensor::Gyro(_) | Sensor::Velocity(Axis::Y | Axis::Z))
}

/// Whether it is exactly zero on a plane, where there is no noise.
fn is_zero_on_a_plane(sensor: Sensor) -> bool {
    is_joint(sensor) || matches!(sensor, Sensor::Gyro(Axis::Y) | Sensor::Accel(Axis::X) | Sensor::Velocity(Axis::Z))
}

fn is_joint(sensor: Sensor) -> bool {
    matches!(sensor, Sensor::BogieAngle(_) | Sensor::RockerAngle)
}

/// Whether it is done without where it says zero.
fn is_done_without(sensor: Sensor) -> bool {
    matches!(sensor, Sensor::LoadCell(..) | Sensor::MotorTorque(..))
}

/// What every sensor said while the rover drove.
#[derive(Debug, Clone)]
pub struct DeadSensors {
    radius_m: f64,
    /// In the order of [`sensors`].
    sensors: Vec<Said>,
    /// Frames in which the rockers are level as they are where both sides do the same.
    mirrored: u32,
}

/// How often a sensor said something, and how often an exact zero.
#[derive(Debug, Clone, Copy, Default)]
struct Said {
    readings: u32,
    zeros: u32,
}

impl DeadSensors {
    /// Of a rover, before its first frame.
    pub fn of(rover: &Rover<f32>) -> Self {
        Self { radius_m: rover.wheel.radius_m.into(), sensors: vec![Said::default(); sensors().len()], mirrored: 0 }
    }

    /// Takes a frame: one in which the rover drives.
    pub fn take(&mut self, frame: &SensorFrame) {
        if !drives(frame, self.radius_m) {
            return;
        }
        for (said, reading) in self.sensors.iter_mut().zip(values(frame)) {
            said.readings += u32::from(reading.is_some());
            said.zeros += u32::from(reading == Some(0.0));
        }
        self.mirrored += u32::from(frame.rocker_angle_rad == Some(0.0) && is_mirrored(frame));
    }

    /// What came of it, without capital and stop.
    pub fn told(&self) -> Option<String> {
        let all = || sensors().into_iter().zip(&self.sensors);
        let has_noise = all().any(|(sensor, said)| is_noisy(sensor) && said.zeros < said.readings);
        let may_be_zero = |sensor| may_be_zero(sensor) || !has_noise && is_zero_on_a_plane(sensor);
        // It stands level where both sides do the same.
        let may_be_level = |sensor, said: &Said| sensor == Sensor::RockerAngle && self.mirrored >= said.zeros;
        let dead: Vec<(Sensor, &Said)> = all()
            .filter(|(sensor, said)| said.is_dead() && !may_be_zero(*sensor) && !may_be_level(*sensor, said))
            .collect();
        let in_words = |(sensor, said): &(Sensor, &Said)| {
            format!("{} (in {} of {} frames)", sensor_name(*sensor), said.zeros, said.readings)
        };
        let named: Vec<String> = dead.iter().map(in_words).collect();
        let believed = dead.iter().map(|(sensor, _)| *sensor).filter(|sensor| !is_done_without(*sensor));
        let believed: Vec<String> = believed.map(sensor_name).collect();
        let then = match (believed.len(), dead.len()) {
            (0, 1) => "this one is treated as missing".to_owned(),
            (0, _) => "these are treated as missing".to_owned(),
            _ => format!("what rests on {} is wrong", believed.join(", ")),
        };
        (!dead.is_empty()).then(|| {
            format!(
                "{} {} exactly 0 while the rover drives: leave the field of a sensor that is not there empty; {then}",
                named.join(", "),
                if dead.len() == 1 { "says" } else { "say" }
            )
        })
    }
}

impl Said {
    fn is_dead(self) -> bool {
        self.readings >= LEAST_READINGS && f64::from(self.zeros) >= NEARLY_ALL * f64::from(self.readings)
    }
}

/// Whether the sensors of both sides say the same, to the last bit, as those of a drive in a plane do that was made without noise.
fn is_mirrored(frame: &SensorFrame) -> bool {
    let PerSide { left, right } = &frame.wheels;
    left == right && frame.bogie_angle_rad.left == frame.bogie_angle_rad.right
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::sensor_channels::{names, values_mut};

    fn begins(name: &str, with: &[&str]) -> bool {
        with.iter().any(|start| name.starts_with(start))
    }

    /// What is said of so many frames, in which each sensor reads this by its name, those of the left wheels a little more.
    fn said(frames: u32, reading: impl Fn(&str, u32) -> f32) -> Option<String> {
        let is_left = |name: &str| ["_fl_", "_ml_", "_rl_"].iter().any(|wheel| name.contains(wheel));
        said_exactly(frames, |name, number| reading(name, number) * if is_left(name) { 1.01 } else { 1.0 })
    }

    /// The same without any more.
    fn said_exactly(frames: u32, reading: impl Fn(&str, u32) -> f32) -> Option<String> {
        let mut dead = DeadSensors::of(&Rover::<f64>::assumed().map(|value| value as f32));
        for number in 0..frames {
            let mut frame = SensorFrame::default();
            for (value, name) in values_mut(&mut frame).zip(names()) {
                *value = Some(reading(&name, number));
            }
            dead.take(&frame);
        }
        dead.told()
    }

    /// What is said where these columns are nothing but zero.
    fn dead(columns: &[&str], frames: u32) -> Option<String> {
        said(frames, |name, _| if columns.contains(&name) { 0.0 } else { 0.5 })
    }

    #[test]
    fn sensors_that_say_nothing_but_zero_are_named() {
        assert_eq!(dead(&[], 100), None);
        assert_eq!(dead(&["load_cell_fl_n"], 49), None, "too few frames tell nothing");
        let told = dead(&["rocker_angle_rad"], 100).expect("a dead joint");
        assert!(told.starts_with("rocker_angle_rad (in 100 of 100 frames) says exactly 0 while the rover"), "{told}");
        for column in ["motor_torque_mr_nm", "accel_x_m_s2", "accel_z_m_s2", "gyro_y_rad_s", "velocity_z_m_s"] {
            assert!(dead(&[column], 60).is_some_and(|told| told.starts_with(column)), "{column}");
        }
        // The encoders tell that it drives.
        let told = dead(&["velocity_x_m_s", "load_cell_rr_n"], 60).expect("two dead sensors");
        let both = "load_cell_rr_n (in 60 of 60 frames), velocity_x_m_s (in 60 of 60 frames) say exactly 0";
        assert!(told.starts_with(both) && told.ends_with("what rests on velocity_x_m_s is wrong"), "{told}");
        let told = dead(&["load_cell_rr_n"], 60).expect("a dead cell");
        assert!(told.ends_with("empty; this one is treated as missing"), "{told}");
    }

    #[test]
    fn what_may_say_zero_is_not_named() {
        for column in ["wheel_rate_fl_rad_s", "gyro_x_rad_s", "gyro_z_rad_s", "velocity_y_m_s", "accel_y_m_s2"] {
            assert_eq!(dead(&[column], 60), None, "{column}");
        }
        // A wheel that is lifted for most of the drive, and a rover that stands.
        assert_eq!(said(100, |name, number| if name == "load_cell_fl_n" && number > 11 { 0.0 } else { 0.5 }), None);
        assert_eq!(said(100, |name, _| if name.starts_with("load_cell") { 70.0 } else { 0.0 }), None);
    }

    /// What goes sideways may be left out: any other sensor that has noise tells that a plane makes no zeros.
    #[test]
    fn a_dead_joint_is_named_where_nothing_goes_sideways() {
        let sideways = |name: &str| begins(name, &["gyro_x", "gyro_z", "velocity_y"]);
        let told = said(100, |name, _| if sideways(name) || name.starts_with("rocker") { 0.0 } else { 0.5 });
        assert!(told.as_ref().is_some_and(|told| told.starts_with("rocker_angle_rad (in 100")), "{told:?}");
    }

    /// Without noise a rover on the level tilts and turns by exactly nothing; its loads and torques are some.
    #[test]
    fn on_a_plane_without_noise_joints_may_say_zero() {
        let bears = |name: &str| begins(name, &["wheel_rate", "motor", "load", "velocity_x", "accel_z"]);
        assert_eq!(said(100, |name, _| if bears(name) { 0.5 } else { 0.0 }), None);
        let told = said(100, |name, _| if bears(name) && name != "load_cell_ml_n" { 0.5 } else { 0.0 });
        assert!(told.as_ref().is_some_and(|told| told.starts_with("load_cell_ml_n (in 100 of")), "{told:?}");
    }

    /// Over hills that are alike on both sides the rockers stay level, while all else turns.
    #[test]
    fn rockers_stay_level_where_both_sides_do_the_same() {
        let in_a_plane = |name: &str| begins(name, &["rocker", "gyro_x", "gyro_z", "velocity_y", "accel_y"]);
        let reading = |name: &str, number| if in_a_plane(name) { 0.0 } else { 0.5 + 0.001 * number as f32 };
        assert_eq!(said_exactly(100, reading), None);
        let told = said(100, reading).expect("a dead joint");
        assert!(told.starts_with("rocker_angle_rad (in 100"), "{told}");
        let told = said_exactly(100, |name, number| if name == "gyro_y_rad_s" { 0.0 } else { reading(name, number) });
        assert!(told.is_some_and(|told| told.starts_with("gyro_y_rad_s (in 100")));
    }
}
