//! What the raw sensors say of the wheels, without any filter: what an estimate must beat to be worth its place.

use std::collections::VecDeque;

use kapvik_firmware::estimator::slip_by_speeds::slip_by;
use kapvik_firmware::rover::{PerWheel, Rover};
use kapvik_firmware::sensor_frame::SensorFrame;

use super::raw_sensors::{links, rockers, wide};
use crate::wheel_quantity::WheelQuantity;

/// What the raw sensors say of one wheel; none where one of the sensors that it takes gave nothing.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct NaiveWheel {
    /// Slip from the encoder as it is and the velocimeter's x: the link's own turning is left out.
    pub slip: Option<f64>,
    /// The drive's torque, N·m.
    pub resistive_torque_nm: Option<f64>,
    /// Pitch of the link that carries the wheel, from accelerometer and joint angles, rad.
    pub contact_angle_rad: Option<f64>,
    /// The load cell, N.
    pub normal_load_n: Option<f64>,
    /// Mass times the accelerometer's x, shared by the load cells, N.
    pub drawbar_pull_n: Option<f64>,
}

impl NaiveWheel {
    /// What they say of a quantity.
    pub fn of(&self, quantity: WheelQuantity) -> Option<f64> {
        match quantity {
            WheelQuantity::Slip => self.slip,
            WheelQuantity::ResistiveTorque => self.resistive_torque_nm,
            WheelQuantity::ContactAngle => self.contact_angle_rad,
            WheelQuantity::NormalLoad => self.normal_load_n,
            WheelQuantity::DrawbarPull => self.drawbar_pull_n,
        }
    }
}

/// What the raw sensors of a frame say.
pub fn naive(rover: &Rover<f64>, frame: &SensorFrame) -> PerWheel<NaiveWheel> {
    let speed = wide(frame.velocity_m_s.x);
    let loads = frame.wheels.map_wheels(|wheel| wide(wheel.load_cell_n));
    let pull = wide(frame.accel_m_s2.x).map(|accel| rover.mass_kg * accel);
    let carried = loads.iter_wheels().copied().sum::<Option<f64>>().filter(|sum| *sum > 0.0);
    let angles = link_pitch(frame);
    frame.wheels.zip_wheels(angles).map_wheels(|(wheel, angle)| {
        let load = wide(wheel.load_cell_n);
        let rim = wide(wheel.rate_rad_s).map(|rate| rover.wheel.radius_m * rate);
        let moves = |(rim, hub): &(f64, f64)| *rim != 0.0 || *hub != 0.0;
        NaiveWheel {
            slip: rim.zip(speed).filter(moves).map(|(rim, hub)| slip_by(rim, hub)),
            resistive_torque_nm: wide(wheel.motor_torque_nm),
            contact_angle_rad: angle,
            normal_load_n: load,
            drawbar_pull_n: pull.zip(carried).zip(load).map(|((pull, carried), load)| pull * load / carried),
        }
    })
}

/// Pitch of the rocker for the front wheels, of the bogies for the others, against the horizontal.
fn link_pitch(frame: &SensorFrame) -> PerWheel<Option<f64>> {
    let accel = frame.accel_m_s2.map(wide).all();
    let pitch = accel.map(|accel| accel.x.atan2(accel.y.hypot(accel.z)));
    links(frame, rockers(frame).map(|rocker| pitch.zip(rocker).map(|(pitch, angle)| pitch + angle)))
}

/// The mean of what the raw sensors said in the second up to each frame.
#[derive(Debug, Default)]
pub struct TrailingMean {
    window: VecDeque<(u64, PerWheel<NaiveWheel>)>,
}

/// How far back the mean reaches, µs.
const WINDOW_US: u64 = 1_000_000;

impl TrailingMean {
    /// Takes what the raw sensors say at `time_us`, and gives the mean of the second that ends there.
    pub fn push(&mut self, time_us: u64, wheels: PerWheel<NaiveWheel>) -> PerWheel<NaiveWheel> {
        self.window.push_back((time_us, wheels));
        while self.window.front().is_some_and(|(time, _)| time.saturating_add(WINDOW_US) <= time_us) {
            self.window.pop_front();
        }
        let places = PerWheel::<()>::default();
        let mut place = 0;
        places.map_wheels(|()| {
            let said = || self.window.iter().filter_map(|(_, wheels)| wheels.iter_wheels().nth(place));
            let mean = NaiveWheel {
                slip: mean(said().map(|wheel| wheel.slip)),
                resistive_torque_nm: mean(said().map(|wheel| wheel.resistive_torque_nm)),
                contact_angle_rad: mean(said().map(|wheel| wheel.contact_angle_rad)),
                normal_load_n: mean(said().map(|wheel| wheel.normal_load_n)),
                drawbar_pull_n: mean(said().map(|wheel| wheel.drawbar_pull_n)),
            };
            place += 1;
            mean
        })
    }
}

/// The mean of those that are there.
fn mean(values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let (sum, count) = values.flatten().fold((0.0, 0_u32), |(sum, count), value| (sum + value, count + 1));
    (count > 0).then(|| sum / f64::from(count))
}

#[cfg(test)]
mod tests {
    use super::*;
    use kapvik_firmware::rover::{Axes, PerAxle, PerSide};
    use kapvik_firmware::sensor_frame::WheelSensors;

    /// Level ground, 0.1 m/s, rims at 0.125 m/s, 60 N on each wheel.
    fn frame() -> SensorFrame {
        let wheel =
            WheelSensors { rate_rad_s: Some(0.125 / 0.075), motor_torque_nm: Some(1.5), load_cell_n: Some(60.0) };
        SensorFrame {
            wheels: PerSide::both(PerAxle::all(wheel)),
            bogie_angle_rad: PerSide { left: Some(0.1), right: Some(-0.1) },
            rocker_angle_rad: Some(0.05),
            accel_m_s2: Axes { x: Some(0.0), y: Some(0.0), z: Some(9.81) },
            velocity_m_s: Axes { x: Some(0.1), y: None, z: None },
            ..SensorFrame::default()
        }
    }

    fn close(value: Option<f64>, expected: f64) {
        let value = value.expect("a value");
        assert!((value - expected).abs() < 1e-5, "{value}, expected {expected}");
    }

    #[test]
    fn level_ground_says_what_it_should() {
        let wheels = naive(&Rover::assumed(), &frame());
        close(wheels.left.front.slip, 0.2);
        close(wheels.left.front.contact_angle_rad, 0.05);
        close(wheels.left.rear.contact_angle_rad, 0.15);
        close(wheels.right.middle.contact_angle_rad, -0.15);
        close(wheels.right.rear.drawbar_pull_n, 0.0);
        close(wheels.right.rear.resistive_torque_nm, 1.5);
    }

    #[test]
    fn a_slope_pulls_with_the_weight_along_it() {
        let mut frame = frame();
        let slope = 10_f32.to_radians();
        frame.accel_m_s2 = Axes { x: Some(9.81 * slope.sin()), y: Some(0.0), z: Some(9.81 * slope.cos()) };
        let wheels = naive(&Rover::assumed(), &frame);
        close(wheels.left.front.contact_angle_rad, f64::from(slope) + 0.05);
        // 41 kg · 9.81 m/s² · sin 10°, a sixth on each wheel.
        close(wheels.left.front.drawbar_pull_n, 11.640_506);
    }

    #[test]
    fn braking_standing_and_silent_sensors() {
        let mut frame = frame();
        frame.wheels.left.front.rate_rad_s = Some(0.05 / 0.075);
        frame.wheels.left.middle.rate_rad_s = Some(0.0);
        frame.wheels.left.rear.load_cell_n = None;
        let wheels = naive(&Rover::assumed(), &frame);
        close(wheels.left.front.slip, -0.5);
        close(wheels.left.middle.slip, -1.0);
        assert_eq!(wheels.left.rear.normal_load_n, None);
        assert_eq!(wheels.right.front.drawbar_pull_n, None, "the share of a load is unknown where a load is");
        frame.velocity_m_s.x = Some(0.0);
        assert_eq!(naive(&Rover::assumed(), &frame).left.middle.slip, None);
    }

    #[test]
    fn the_mean_is_that_of_the_last_second() {
        let said = |load| PerSide::both(PerAxle::all(NaiveWheel { normal_load_n: load, ..NaiveWheel::default() }));
        let mut mean = TrailingMean::default();
        let loads = [Some(10.0), Some(20.0), None, Some(60.0)];
        let means: Vec<_> = loads
            .into_iter()
            .zip([0, 500_000, 700_000, 1_000_000])
            .map(|(load, time)| mean.push(time, said(load)).right.rear.normal_load_n)
            .collect();
        assert_eq!(means, [Some(10.0), Some(15.0), Some(15.0), Some(40.0)]);
    }
}
