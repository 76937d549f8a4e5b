//! What a recording itself shows of signs, zeros and mountings, on drives of the simulator: silent where all is as agreed, and not where a
//! sensor is otherwise.

mod recorded;

use clap::ValueEnum;
use kapvik_firmware::rover::Rover;
use kapvik_firmware::sensor_frame::SensorFrame;
use kapvik_host::replay::Doubts;
use kapvik_host::simulate::{Options, Scenario};
use rayon::prelude::*;
use recorded::recorded;

/// What is doubted of a drive whose frames are changed so.
fn doubted(scenario: Scenario, seed: u64, change: impl Fn(&mut SensorFrame)) -> Vec<String> {
    let rover = Rover::assumed();
    let mut doubts = Doubts::of(&rover.map(|value| value as f32));
    for (frame, _) in recorded(scenario, seed, &rover, &Options::default()).iter() {
        let mut frame = *frame;
        change(&mut frame);
        doubts.take(&frame);
    }
    doubts.told()
}

#[test]
fn sensors_that_agree_are_not_doubted() {
    let scenarios = Scenario::value_variants().par_iter();
    let drives = scenarios.flat_map_iter(|scenario| (8500..8506).map(move |seed| (*scenario, seed)));
    drives.for_each(|(scenario, seed)| {
        let told = doubted(scenario, seed, |_| ());
        assert!(told.is_empty(), "{scenario:?}, seed {seed}: {told:?}");
    });
}

fn add(reading: &mut Option<f32>, more: f32) {
    *reading = reading.map(|value| value + more);
}

fn turn(reading: &mut Option<f32>) {
    *reading = reading.map(|value| -value);
}

/// The doubt that begins so, and no other, on all drives.
fn is_told(scenario: Scenario, begins: &str, change: impl Fn(&mut SensorFrame) + Sync) {
    (8510..8514).into_par_iter().for_each(|seed| {
        let told = doubted(scenario, seed, &change);
        assert!(told.len() == 1 && told[0].starts_with(begins), "{begins}: {scenario:?}, seed {seed}: {told:?}");
    });
}

#[test]
fn a_zero_of_the_gyro_is_told() {
    for scenario in [Scenario::Level, Scenario::Hills, Scenario::Rock] {
        is_told(scenario, "gyro_y says 0.00", |frame| add(&mut frame.gyro_rad_s.y, 0.001));
        is_told(scenario, "gyro_y says -0.00", |frame| add(&mut frame.gyro_rad_s.y, -0.002));
    }
    is_told(Scenario::StartStop, "gyro_z says 0.00", |frame| add(&mut frame.gyro_rad_s.z, 0.002));
}

#[test]
fn a_wrong_sign_is_told() {
    is_told(Scenario::Hills, "gyro_y turns the other way", |frame| turn(&mut frame.gyro_rad_s.y));
    is_told(Scenario::Level, "velocity_x and all encoders", |frame| turn(&mut frame.velocity_m_s.x));
    is_told(Scenario::Spread, "the encoders of ml turn against", |frame| {
        turn(&mut frame.wheels.left.middle.rate_rad_s);
    });
    // Drives on which this wheel slips by half.
    for seed in [8510, 8512, 8513] {
        let told = doubted(Scenario::Spread, seed, |frame| turn(&mut frame.wheels.right.middle.motor_torque_nm));
        assert!(told.len() == 1 && told[0].starts_with("the motor torques of mr go against"), "seed {seed}: {told:?}");
    }
}

#[test]
fn a_joint_that_is_read_the_other_way_round_is_told() {
    let begins = |columns: &str| format!("{columns} the wrong sign");
    for scenario in [Scenario::Hills, Scenario::Rock, Scenario::Traverse] {
        is_told(scenario, &begins("rocker_angle_rad has"), |frame| turn(&mut frame.rocker_angle_rad));
    }
    for scenario in [Scenario::Hills, Scenario::Traverse] {
        is_told(scenario, &begins("bogie_angle_r_rad has"), |frame| turn(&mut frame.bogie_angle_rad.right));
        is_told(scenario, &begins("bogie_angle_l_rad, bogie_angle_r_rad have"), |frame| {
            frame.bogie_angle_rad.as_array_mut().into_iter().for_each(turn);
        });
    }
}

#[test]
fn a_camera_that_is_mounted_askew_is_told() {
    let (sine, cosine) = 0.035_f32.sin_cos();
    for scenario in [Scenario::Level, Scenario::Hills, Scenario::Slope] {
        is_told(scenario, "the velocimeter sees the rover go", |frame| {
            let velocity = &mut frame.velocity_m_s;
            let (ahead, up) = (velocity.x, velocity.z);
            velocity.x = ahead.zip(up).map(|(ahead, up)| cosine * ahead - sine * up);
            velocity.z = ahead.zip(up).map(|(ahead, up)| sine * ahead + cosine * up);
        });
    }
}

/// The doubt that begins so comes first on all drives: what others are told of may hang on it.
fn is_told_first(scenario: Scenario, begins: &str, change: impl Fn(&mut SensorFrame) + Sync) {
    (8510..8514).into_par_iter().for_each(|seed| {
        let told = doubted(scenario, seed, &change);
        assert!(
            told.first().is_some_and(|told| told.starts_with(begins)),
            "{begins}: {scenario:?}, seed {seed}: {told:?}"
        );
    });
}

#[test]
fn a_sensor_that_says_nothing_but_zero_is_told() {
    for scenario in [Scenario::Level, Scenario::Hills] {
        is_told(scenario, "motor_torque_mr_nm (in ", |frame| {
            frame.wheels.right.middle.motor_torque_nm = Some(0.0);
        });
        is_told_first(scenario, "rocker_angle_rad (in ", |frame| frame.rocker_angle_rad = Some(0.0));
        is_told_first(scenario, "velocity_x_m_s (in ", |frame| frame.velocity_m_s.x = Some(0.0));
    }
}

#[test]
fn a_clock_that_is_rounded_too_coarsely_is_told() {
    for scenario in [Scenario::Level, Scenario::Hills] {
        let (rounded, of_frames) = (500_000, "frames have the time of the frame before and other readings");
        (8510..8514).into_par_iter().for_each(|seed| {
            let told = doubted(scenario, seed, |frame| frame.time_us -= frame.time_us % rounded);
            assert!(told.first().is_some_and(|told| told.contains(of_frames)), "{scenario:?}, seed {seed}: {told:?}");
        });
    }
}
