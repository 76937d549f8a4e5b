//! Sensors that speak in some frames only, encoders of drives that hold their rate, records that begin on the way: what is stated of the
//! wheels must stay near the truth.

mod drive_errors;
mod driven;
mod failing;
mod faulty_drives;
mod recorded;
#[path = "../../firmware/tests/support/worse.rs"]
mod worse;

use driven::driven;
use kapvik_firmware::pipeline::FrameEstimate;
use kapvik_firmware::rover::Rover;
use kapvik_host::data::truth_file::Truth;
use kapvik_host::simulate::faults::{Failure, Fault};
use kapvik_host::simulate::{Options, Scenario};
use kapvik_host::trial::Quantity;
use kapvik_host::trial::errors::Errors;
use recorded::recorded;
use worse::worse;

/// Seeds that development has not looked at.
const SEEDS: std::ops::Range<u64> = 8300..8304;
/// Drives are not longer, s.
const LONGEST_S: f64 = 120.0;

fn errors(scenario: Scenario, faults: &[Fault]) -> Errors {
    faulty_drives::errors(scenario, SEEDS, faults)
}

/// Errors may grow to four times those with all readings, give or take one, and so many must be within two standard deviations.
const TIMES: f64 = 5.0;
const LEAST: f64 = 0.85;

/// Without a sensor for good errors are what they are, but so many must be within two standard deviations.
const LEAST_WITHOUT: f64 = 0.8;

/// What is compared, and the most that it errs by without whichever sensor: SI units, a third above what is found.
const MOST_WITHOUT: [(Quantity, f64); 5] = [
    (Quantity::Slip, 0.25),
    (Quantity::Torque, 2.0),
    (Quantity::ContactAngle, 0.07),
    (Quantity::Load, 1.1),
    (Quantity::FrontPull, 7.5),
];

/// Prints errors with some readings and with all. So many must be within two standard deviations, and they may grow to what is allowed, of a
/// quantity's [`MOST_WITHOUT`] and what it errs by with all.
fn compare(what: &str, with: &Errors, without: &Errors, least: f64, allowed: impl Fn(f64, f64) -> f64) {
    for (quantity, most) in MOST_WITHOUT {
        let (tally, whole) = (with.of(quantity), without.of(quantity));
        let [one, two] = tally.coverage();
        println!("{what}, {quantity:?}: {:.4}, {:.4} with all; {one:.3} {two:.3} within", tally.rmse(), whole.rmse());
        assert!(two >= least, "{what}, {quantity:?}: {two} within two standard deviations");
        assert!(tally.rmse() <= allowed(most, whole.rmse()), "{what}, {quantity:?}: {}", tally.rmse());
    }
}

#[test]
fn sensors_that_speak_in_one_frame_of_five_are_heard() {
    for scenario in [Scenario::Level, Scenario::Hills] {
        let whole = errors(scenario, &[]);
        for columns in ["load_cell_*", "velocity_*", "motor_torque_*", "wheel_rate_*", "bogie_angle_*", "gyro_*"] {
            let faults = Fault::silent_but_one_in(5, columns, LONGEST_S).expect("faults");
            let what = format!("{scenario:?}, {columns} in one frame of five");
            compare(&what, &errors(scenario, &faults), &whole, LEAST, |_, of_all| TIMES * of_all);
        }
    }
}

/// What is lost with a sensor that never says anything is lost, and must be stated.
#[test]
fn sensors_that_are_silent_for_good_are_missed_honestly() {
    for scenario in [Scenario::Level, Scenario::Hills] {
        let whole = errors(scenario, &[]);
        let one_or_all = ["motor_torque_*", "load_cell_ml_n", "wheel_rate_fl_rad_s", "wheel_rate_*", "velocity_z_m_s"];
        for columns in
            ["rocker_angle_rad", "bogie_angle_*", "velocity_*", "gyro_*", "accel_*"].iter().chain(&one_or_all)
        {
            let fault = Fault::new(Failure::Dropout, columns, (0.0, LONGEST_S)).expect("a fault");
            let what = format!("{scenario:?}, never {columns}");
            compare(&what, &errors(scenario, &[fault]), &whole, LEAST_WITHOUT, |most, _| most);
        }
    }
}

/// What the other sensors tell as well is hardly missed: a wheel's torque by its drive without the encoder, how the rover rises by its links.
#[test]
fn an_encoder_or_the_rise_is_hardly_missed() {
    let whole = errors(Scenario::Hills, &[]);
    for (columns, quantities) in [
        ("wheel_rate_fl_rad_s", [Quantity::Torque, Quantity::ContactAngle, Quantity::FrontPull]),
        ("velocity_z_m_s", [Quantity::Slip, Quantity::Torque, Quantity::Load]),
    ] {
        let fault = Fault::new(Failure::Dropout, columns, (0.0, LONGEST_S)).expect("a fault");
        let without = errors(Scenario::Hills, &[fault]);
        for quantity in quantities {
            let (rmse, of_all) = (without.of(quantity).rmse(), whole.of(quantity).rmse());
            println!("never {columns}, {quantity:?}: {rmse:.4}, {of_all:.4} with all");
            assert!(rmse <= 2.0 * of_all, "never {columns}, {quantity:?}: {rmse}, {of_all} with all");
        }
    }
}

/// The share of contact angles and drawbar pulls within two standard deviations, and the largest error in them.
fn honesty(pairs: &[(FrameEstimate, Truth)]) -> (f64, f64) {
    let errors: Vec<f64> = pairs
        .iter()
        .flat_map(|(estimate, truth)| {
            let wheels = estimate.wheels.iter_wheels().zip(truth.wheels.iter_wheels());
            wheels.flat_map(|(wheel, truth)| {
                let of = |value: f32, std: f32, truth: f64| ((f64::from(value) - truth) / f64::from(std)).abs();
                let (angle, pull) = (wheel.contact_angle_rad, wheel.drawbar_pull_n);
                [of(angle.value, angle.std, truth.contact_angle_rad), of(pull.value, pull.std, truth.drawbar_pull_n)]
            })
        })
        .collect();
    let within = errors.iter().filter(|error| **error <= 2.0).count();
    (within as f64 / errors.len() as f64, errors.into_iter().fold(0.0, worse))
}

/// Frames come five times as fast, and the record begins on hills, of which nothing is known then.
#[test]
fn a_record_of_fast_frames_that_begins_on_hills_is_stated_honestly() {
    let options = Options { rate_hz: Some(50.0), duration_s: Some(40.0), ..Options::default() };
    for seed in SEEDS {
        let rover = Rover::<f64>::assumed();
        let frames = recorded(Scenario::Hills, seed, &rover, &options);
        for begins_s in [8.0, 16.0] {
            let from = |time_s: f64| frames.partition_point(|(frame, _)| (frame.time_us as f64) < 1e6 * time_s);
            let (begins, counts) = (from(begins_s), from(begins_s + 3.0));
            let (pairs, _) = driven(&rover, frames.iter().skip(begins).copied());
            let (within, most) = honesty(&pairs[counts - begins..]);
            println!("seed {seed} from {begins_s} s on: {within:.3} within two standard deviations, at most {most:.1}");
            assert!(within >= 0.8 && most < 10.0, "seed {seed} from {begins_s} s on: {within}, {most}");
        }
    }
}

/// A drive that holds its rate, behind an encoder too coarse to show how well, says the same for minutes. That is counted as stuck, and
/// the rate is believed a little less.
#[test]
fn an_encoder_that_always_says_the_same_is_not_lost() {
    const STEP_RAD_S: f32 = 0.01;
    for scenario in [Scenario::Level, Scenario::Hills] {
        let rover = Rover::assumed();
        let mut frames = recorded(scenario, SEEDS.start, &rover, &Options::default()).to_vec();
        for wheel in frames.iter_mut().flat_map(|(frame, _)| frame.wheels.iter_wheels_mut()) {
            wheel.rate_rad_s = wheel.rate_rad_s.map(|rate| (rate / STEP_RAD_S).round() * STEP_RAD_S);
        }
        let (said, pipeline) = driven(&rover, frames);
        let (mut squares, mut within, mut count) = (0.0, 0.0, 0.0);
        for (estimate, truth) in said.iter().filter(|(estimate, _)| estimate.time_us >= 5_000_000) {
            for (wheel, truth) in estimate.wheels.iter_wheels().zip(truth.wheels.iter_wheels()) {
                let (Some(slip), Some(truth)) = (wheel.slip, truth.slip) else { continue };
                let error = f64::from(slip.value) - truth;
                squares += error * error;
                within += f64::from(u8::from(error.abs() <= 2.0 * f64::from(slip.std)));
                count += 1.0;
            }
        }
        let (rms, within) = (f64::sqrt(squares / count), within / count);
        println!("{scenario:?}: slip errs by {rms:.4}, {within:.3} within two standard deviations");
        assert!(rms < 0.03 && within >= 0.85, "{scenario:?}: {rms}, {within}");
        let stuck = pipeline.health().sensors.wheel_rate.left.front.stuck;
        assert!(stuck > 100, "{scenario:?}: {stuck} readings counted as stuck");
    }
}

/// At one frame a second a rover starts for some frames, too: what its wheels do then is no other soil.
#[test]
fn a_record_of_one_frame_a_second_claims_no_soil() {
    let options = Options { rate_hz: Some(1.0), duration_s: Some(60.0), ..Options::default() };
    let rover = Rover::assumed();
    for (scenario, seed) in
        [Scenario::Level, Scenario::Spread].into_iter().flat_map(|s| SEEDS.map(move |seed| (s, seed)))
    {
        let (said, _) = driven(&rover, recorded(scenario, seed, &rover, &options).iter().copied());
        let soil = said.last().and_then(|(estimate, _)| estimate.soil.ok()).expect("it rolls");
        assert_eq!(soil.changes, 0, "{scenario:?}, seed {seed}");
    }
}
