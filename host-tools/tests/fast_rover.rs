//! A rover at twenty centimetres a second, whose links turn so fast on hills that the inertia of its drives shows.
//!
//! The simulator's drives go at a few centimetres a second: a slow drive of a rover of 8² times the inertia, told in an eighth of the time,
//! is one of a fast rover on the same ground, for nothing else in it has a mass.

mod driven;

use driven::driven;
use kapvik_firmware::rover::Rover;
use kapvik_firmware::sensor_frame::SensorFrame;
use kapvik_host::simulate::{Options, Scenario, Traverse};
use kapvik_host::trial::tally::Tally;

/// Seeds that development has not looked at.
const SEEDS: std::ops::Range<u64> = 8330..8333;
const FASTER: f64 = 8.0;
const RATE_HZ: f64 = 50.0;
/// From then on its torques are looked at, s.
const STARTED_S: f64 = 3.0;

fn slower(rover: &Rover<f64>) -> Rover<f64> {
    let mut slow = *rover;
    slow.drive.reflected_inertia_kg_m2 *= FASTER * FASTER;
    for noise in [&mut slow.noise.wheel_rate_rad_s, &mut slow.noise.gyro_rad_s, &mut slow.noise.velocity_m_s] {
        *noise /= FASTER;
    }
    slow
}

fn faster(mut frame: SensorFrame) -> SensorFrame {
    frame.time_us /= FASTER as u64;
    let speeds_up = |reading: Option<f32>| reading.map(|reading| reading * FASTER as f32);
    frame.wheels.iter_wheels_mut().for_each(|wheel| wheel.rate_rad_s = speeds_up(wheel.rate_rad_s));
    frame.gyro_rad_s = frame.gyro_rad_s.map(speeds_up);
    frame.velocity_m_s = frame.velocity_m_s.map(speeds_up);
    frame
}

fn drive(seed: u64, torques: &mut Tally) {
    let rover = Rover::assumed();
    let options = Options { rate_hz: Some(RATE_HZ / FASTER), ..Options::default() };
    let traverse = Traverse::new(Scenario::Hills, seed, &slower(&rover), &options).expect("a drive");
    let frames: Vec<_> =
        traverse.run().expect("frames").into_iter().map(|(frame, truth)| (faster(frame), truth)).collect();
    let (said, _) = driven(&rover, frames.iter().copied());
    for ((estimate, truth), (frame, _)) in said.iter().zip(&frames) {
        if frame.time_us < (1.0e6 * STARTED_S) as u64 {
            continue;
        }
        let truths = truth.wheels.iter_wheels().map(|wheel| wheel.resistive_torque_nm);
        let sensors = frame.wheels.iter_wheels().filter_map(|wheel| wheel.motor_torque_nm);
        for ((wheel, truth), sensor) in estimate.wheels.iter_wheels().zip(truths).zip(sensors) {
            let sensor = Some(f64::from(sensor));
            torques.take(wheel.resistive_torque_nm, sensor, sensor, truth);
        }
    }
}

#[test]
fn torques_of_a_fast_rover_are_better_than_its_sensors_and_say_how_well() {
    let mut torques = Tally::default();
    SEEDS.for_each(|seed| drive(seed, &mut torques));
    let (ratio, [_, within_two]) = (torques.over_naive(), torques.coverage());
    println!("torque: {ratio:.3} of the raw sensors, {within_two:.3} within two standard deviations");
    assert!(ratio <= 0.7 && within_two >= 0.9, "{ratio} {within_two}");
}
