//! Sensors as the conventions define them, and their noise.

use kapvik_firmware::rover::Rover;
use kapvik_host::data::sensor_channels::{names, values};
use kapvik_host::simulate::effects::RoverEffects;
use kapvik_host::simulate::{Options, Scenario, Traverse};

use super::{drive, given};

const G: f64 = 9.81;

#[test]
fn at_rest_the_accelerometer_feels_gravity_and_the_load_cells_the_weight() {
    for scenario in [Scenario::Level, Scenario::Slope] {
        let (frame, truth) = drive(scenario, 1, &Options::default())[0];
        let (sine, cosine) = truth.pitch_rad.sin_cos();
        for (found, expected) in [
            (given(frame.accel_m_s2.x), G * sine),
            (given(frame.accel_m_s2.y), 0.0),
            (given(frame.accel_m_s2.z), G * cosine),
        ] {
            assert!((found - expected).abs() < 1.0e-6, "{scenario:?}: {found} {expected}");
        }
        for turn in frame.gyro_rad_s.as_array() {
            assert!(given(*turn).abs() < 1.0e-9);
        }
        assert!(frame.velocity_m_s.as_array().into_iter().all(|speed| given(*speed).abs() < 2.0e-5), "it creeps");
        for wheel in frame.wheels.iter_wheels() {
            assert!(given(wheel.rate_rad_s).abs() < 1.0e-9);
        }
    }
    let (frame, truth) = drive(Scenario::Level, 1, &Options::default())[0];
    for (sensors, wheel) in frame.wheels.iter_wheels().zip(truth.wheels.iter_wheels()) {
        // A sixth of the weight each, which the rover's symmetry gives.
        assert!((given(sensors.load_cell_n) - 41.0 * G / 6.0).abs() < 1.0e-5);
        assert!(given(sensors.motor_torque_nm).abs() < 1.0e-6 && wheel.slip.is_none());
    }
}

/// Slip, torque and load from noiseless sensors by the conventions' definitions, on plane ground.
#[test]
fn moving_sensors_lead_to_the_truth() {
    let rover = Rover::<f64>::assumed();
    for scenario in [Scenario::Spread, Scenario::Slope] {
        let rows = drive(scenario, 2, &Options::default());
        for pair in rows.windows(3).skip(100) {
            let [before, (frame, truth), after] = pair else { unreachable!("three rows") };
            let gamma = if scenario == Scenario::Slope { 10.0_f64.to_radians() } else { 0.0 };
            let (ahead, up) = (given(frame.velocity_m_s.x), given(frame.velocity_m_s.z));
            let level = truth.pitch_rad - gamma;
            let speed = ahead * level.cos() - up * level.sin();
            let joints = (given(frame.rocker_angle_rad), given(frame.bogie_angle_rad.left));
            let wheels = [
                (frame.wheels.left.front, truth.wheels.left.front, joints.0),
                (frame.wheels.left.rear, truth.wheels.left.rear, joints.0 + joints.1),
            ];
            for (sensors, wheel, link_rad) in wheels {
                // Links and body stand all but still on plane ground.
                let slip = 1.0 - speed / (rover.wheel.radius_m * given(sensors.rate_rad_s));
                assert!((slip - wheel.slip.expect("it moves")).abs() < 5.0e-4, "{scenario:?}: {slip} {:?}", wheel.slip);
                let psi = truth.pitch_rad + link_rad;
                let (sine, cosine) = (gamma - psi).sin_cos();
                let cell = wheel.normal_load_n * cosine + wheel.drawbar_pull_n * sine;
                assert!((given(sensors.load_cell_n) - cell).abs() < 1.0e-4, "{scenario:?}: {cell}");
            }
            let rate = |row: &(_, _)| {
                let frame: &kapvik_firmware::sensor_frame::SensorFrame = &row.0;
                let _: &kapvik_host::data::truth_file::Truth = &row.1;
                given(frame.wheels.right.middle.rate_rad_s)
            };
            let growth = (rate(after) - rate(before)) / 0.2;
            let torque = truth.wheels.right.middle.resistive_torque_nm + 2.1 * growth;
            assert!((given(frame.wheels.right.middle.motor_torque_nm) - torque).abs() < 1.0e-4);
        }
    }
}

#[test]
fn nose_up_is_a_negative_rate_about_y() {
    let rows = drive(Scenario::Rock, 4, &Options { rate_hz: Some(20.0), ..Options::default() });
    let mut fastest: f64 = 0.0;
    for triple in rows.windows(3).skip(100) {
        let [before, (frame, _), after] = triple else { unreachable!("three rows") };
        let pitching = (after.1.pitch_rad - before.1.pitch_rad) / 0.1;
        let rolling = (after.1.roll_rad - before.1.roll_rad) / 0.1;
        assert!((given(frame.gyro_rad_s.y) + pitching).abs() < 1.0e-4);
        assert!((given(frame.gyro_rad_s.x) - rolling).abs() < 1.0e-4);
        fastest = fastest.max(pitching.abs());
    }
    assert!(fastest > 0.005, "the rock pitches the rover: {fastest}");
}

/// Each channel's noise: mean, size and whiteness within four standard errors, which one of a hundred channels and
/// statistics misses by chance once in 160 seeds.
#[test]
fn noise_is_white_and_as_large_as_the_rover_file_says() {
    let options = Options { duration_s: Some(200.0), ..Options::default() };
    let assumed = Rover::<f64>::assumed();
    let noisy = Traverse::new(Scenario::Level, 8, &assumed, &options).expect("a drive").run().expect("frames");
    let quiet = drive(Scenario::Level, 8, &options);
    let noise = assumed.noise;
    for (channel, name) in names().iter().enumerate() {
        let std = match name.as_str() {
            name if name.starts_with("wheel_rate") => noise.wheel_rate_rad_s,
            name if name.starts_with("motor_torque") => noise.motor_torque_nm,
            name if name.starts_with("load_cell") => noise.load_cell_n,
            name if name.starts_with("accel") => noise.accel_m_s2,
            name if name.starts_with("gyro") => noise.gyro_rad_s,
            name if name.starts_with("velocity") => noise.velocity_m_s,
            _ => noise.angle_rad,
        };
        let residuals: Vec<f64> = noisy
            .iter()
            .zip(quiet.iter())
            .map(|(noisy, quiet)| (given(values(&noisy.0)[channel]) - given(values(&quiet.0)[channel])) / std)
            .collect();
        let count = residuals.len() as f64;
        let mean = residuals.iter().sum::<f64>() / count;
        let square = residuals.iter().map(|residual| residual * residual).sum::<f64>() / count;
        let lagged = residuals.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>() / count;
        assert!(mean.abs() < 4.0 / count.sqrt(), "{name}: mean {mean}");
        assert!((square - 1.0).abs() < 4.0 * (2.0 / count).sqrt(), "{name}: mean square {square}");
        assert!(lagged.abs() < 4.0 / count.sqrt(), "{name}: correlation from frame to frame {lagged}");
    }
}

/// A drive with one effect, and the same without.
fn with_effect(id: &str, value: f64) -> Vec<[(kapvik_firmware::sensor_frame::SensorFrame, f64); 2]> {
    let effects = RoverEffects::only(id, value).unwrap();
    let options = Options { duration_s: Some(20.0), effects, ..Options::default() };
    let with = drive(Scenario::Slope, 6, &options);
    let without = drive(Scenario::Slope, 6, &Options { effects: RoverEffects::default(), ..options });
    with.iter()
        .zip(without.iter())
        .map(|(with, without)| {
            [with, without].map(|(frame, truth)| (*frame, truth.wheels.left.front.slip.unwrap_or(0.0)))
        })
        .collect()
}

#[test]
fn effects_do_what_their_names_say() {
    type Frame = kapvik_firmware::sensor_frame::SensorFrame;
    type Reading = fn(&Frame) -> f64;
    let torque: Reading = |frame| given(frame.wheels.left.front.motor_torque_nm);
    let cell: Reading = |frame| given(frame.wheels.right.rear.load_cell_n);
    let rate: Reading = |frame| given(frame.wheels.left.front.rate_rad_s);
    let speed: Reading = |frame| given(frame.velocity_m_s.x);
    // Each expected change from the reading without, at a time.
    type Expected = fn(&Frame, f64) -> f64;
    let cases: [(&str, f64, Reading, Expected); 6] = [
        ("drive-friction", 0.3, torque, |frame, _| 0.3 * given(frame.wheels.left.front.rate_rad_s).signum()),
        ("drive-viscosity", 2.0, torque, |frame, _| 2.0 * given(frame.wheels.left.front.rate_rad_s)),
        ("torque-scale", 0.1, torque, |frame, _| 0.1 * given(frame.wheels.left.front.motor_torque_nm)),
        ("force-bias", -3.0, cell, |_, _| -3.0),
        ("force-drift", 720.0, cell, |_, time_s| 0.2 * time_s),
        ("velocity-scale", 0.02, speed, |frame, _| 0.02 * given(frame.velocity_m_s.x)),
    ];
    for (id, value, reading, expected) in cases {
        // Once it moves: friction has no sign before.
        for [(with, _), (without, _)] in with_effect(id, value).into_iter().skip(30) {
            let found = reading(&with) - reading(&without);
            let expected = expected(&without, 1.0e-6 * without.time_us as f64);
            assert!((found - expected).abs() < 2.0e-5, "{id}: {found}, expected {expected}");
        }
    }
    let rows = with_effect("pitch-misalignment", 0.01);
    let [(with, _), (without, _)] = rows[0];
    let tilt = |frame: &Frame| given(frame.accel_m_s2.x).atan2(given(frame.accel_m_s2.z));
    assert!((tilt(&with) - tilt(&without) - 0.01).abs() < 1.0e-6, "it seems nose-up by as much");
    let rows = with_effect("latency", 0.25);
    for place in 10..rows.len() {
        let expected = 0.5 * (speed(&rows[place - 2][1].0) + speed(&rows[place - 3][1].0));
        assert!((speed(&rows[place][0].0) - expected).abs() < 1.0e-6, "a quarter of a second late");
    }
    // A wheel that is 5 mm larger turns at a rate that suits its true rim speed; slip by the file's radius is wrong.
    for [(with, slip), _] in with_effect("rolling-radius", 0.005).into_iter().skip(60) {
        let true_speed = speed(&with) / (1.0 - slip);
        assert!((rate(&with) * 0.080 - true_speed).abs() < 2.0e-5, "{} {true_speed}", rate(&with));
    }
    // On the slope the bogie's link tilts up with the ground, and the force along it is nearly the pull.
    let rows = with_effect("crosstalk", 0.1);
    let [(with, _), (without, _)] = rows[rows.len() - 1];
    let leaked = cell(&with) - cell(&without);
    assert!(leaked > 0.5 && leaked < 2.5, "a tenth of the rear wheel's pull: {leaked}");
}
