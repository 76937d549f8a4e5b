//! Every fault of every sensor, in the middle of simulated drives: the estimators survive it, say so, and are back in time.

mod driven;
mod failing;
mod recorded;

use driven::driven;
use failing::failing;
use kapvik_firmware::estimator::Estimate;
use kapvik_firmware::rover::Rover;
use kapvik_host::bench::faults::REPORTED;
use kapvik_host::replay::troubles;
use kapvik_host::simulate::faults::{Failure, Fault};
use kapvik_host::simulate::{Options, Scenario};
use kapvik_host::trial::faults::{ALLOWED_FRAMES, Case, catalogue};
use recorded::recorded;

/// Spread slips and hills, four drives each. A drive in which the estimates are out of bounds without a fault is asked for no
/// better than that: see [`kapvik_host::trial::faults::Outcome::frames_to_recover`].
#[test]
fn every_fault_is_survived_counted_and_over_in_twenty_frames() {
    assert_eq!(Case::all().len(), 30 * 5 + 3);
    let catalogue = catalogue(&REPORTED, 40..44, &Rover::assumed());
    assert_eq!((catalogue.drives, catalogue.outcomes.len()), (8, 8 * 153), "{:?}", catalogue.failures);
    for (scenario, seed, outcome) in &catalogue.outcomes {
        let which = format!("{scenario:?} {seed}, {:?}", outcome.case);
        assert_eq!(outcome.not_finite, 0, "{which}: not every number is finite");
        assert!(outcome.miscounted.is_empty(), "{which}: the health is wrong about {:?}", outcome.miscounted);
        let back = outcome.frames_to_recover.is_some_and(|frames| frames <= ALLOWED_FRAMES);
        assert!(back, "{which}: back after {:?} frames", outcome.frames_to_recover);
    }
}

/// When a sensor is dead, s, both included, and in how many frames.
const DEAD_S: (f64, f64) = (25.0, 32.0);
const DEAD_FRAMES: u16 = 71;
/// Until when what comes of it is looked at, s.
const WATCHED_UNTIL_S: f64 = 35.0;
/// Standard deviations by which load and pull of a wheel may be off; the share of the frames in which they must be within these, and by how
/// much it may be less than where the sensor says nothing.
const LIMIT: f64 = 4.0;
const MOST: f64 = 0.9;
const LESS: f64 = 0.02;

/// How often a sensor that is dead on hills is counted for this reason, and the share of frames in which load and pull are true, of the wheel of
/// which they are least often.
fn counted_and_true(failure: Failure, column: &str, reason: &str, seed: u64) -> (u16, f64) {
    let fault = Fault::new(failure, column, DEAD_S).expect("a fault");
    let options = Options { duration_s: Some(60.0), ..Options::default() };
    let rover = Rover::assumed();
    let drive = recorded(Scenario::Hills, seed, &rover, &options);
    let (said, pipeline) = driven(&rover, failing(&drive, vec![fault]));
    let (mut frames, mut true_frames) = (0_u32, [0_u32; 6]);
    for (estimate, truth) in said {
        if !(DEAD_S.0..=WATCHED_UNTIL_S).contains(&(1e-6 * truth.time_us as f64)) {
            continue;
        }
        frames += 1;
        let wheels = estimate.wheels.iter_wheels().zip(truth.wheels.iter_wheels());
        for (true_frames, (said, truly)) in true_frames.iter_mut().zip(wheels) {
            let loads = is_true(said.normal_load_n, truly.normal_load_n);
            *true_frames += u32::from(loads && is_true(said.drawbar_pull_n, truly.drawbar_pull_n));
        }
    }
    let troubles = troubles(pipeline.health());
    let counted = troubles.iter().find(|trouble| trouble.sensor == column).and_then(|trouble| trouble.count(reason));
    let least = true_frames.into_iter().min().map_or(0.0, f64::from);
    (counted.unwrap_or(0), least / f64::from(frames))
}

fn is_true(said: Estimate, truly: f64) -> bool {
    (f64::from(said.value) - truly).abs() <= LIMIT * f64::from(said.std)
}

/// Loggers that have no word for what is missing write zero; the estimates must do without as well as where the field is empty.
#[test]
fn a_sensor_that_says_zero_is_noticed_and_done_without() {
    // What an accelerometer says along the upright may be zero on a slope that no rover stands on: there it surprises.
    for (column, reason) in
        [("load_cell_rr_n", "stuck"), ("motor_torque_fl_nm", "stuck"), ("accel_z_m_s2", "surprising")]
    {
        for seed in [9600, 9602, 9603] {
            let (_, without) = counted_and_true(Failure::Dropout, column, "missing", seed);
            let (counted, dead) = counted_and_true(Failure::Zero, column, reason, seed);
            println!(
                "{column}, seed {seed}: true in {dead:.3} of the frames, in {without:.3} where the field is empty"
            );
            assert!(counted >= DEAD_FRAMES, "{column}, seed {seed}: {counted} readings are {reason}");
            assert!(dead >= MOST && dead >= without - LESS, "{column}, seed {seed}: true in {dead} of the frames");
        }
    }
}
