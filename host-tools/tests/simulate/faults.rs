//! Every failure does what its name says, in its columns and at its time, and nothing else.

use kapvik_firmware::sensor_frame::SensorFrame;
use kapvik_host::data::sensor_channels::{names, values};
use kapvik_host::simulate::faults::{FAILURES, Failure, Fault};
use kapvik_host::simulate::{Options, Scenario};

use super::drive;

fn frames(faults: Vec<Fault>) -> Vec<SensorFrame> {
    let options = Options { duration_s: Some(8.0), faults, ..Options::default() };
    drive(Scenario::Level, 3, &options).iter().map(|(frame, _)| *frame).collect()
}

#[test]
fn failures_change_their_columns_at_their_time_and_nothing_else() {
    let clean = frames(Vec::new());
    for (failure, pattern, columns) in [
        (Failure::Nan, "load_cell_fl_n", 1),
        (Failure::Infinity, "gyro_*", 3),
        (Failure::Outlier, "*_rr_*", 3),
        (Failure::Stuck, "velocity_*_m_s", 3),
        (Failure::Zero, "accel_*", 3),
        (Failure::Glitch, "motor_torque_*", 6),
        (Failure::Dropout, "*", 30),
    ] {
        let fault = Fault::new(failure, pattern, (4.0, 5.0)).expect("a fault");
        assert_eq!(fault.columns.iter().filter(|fails| **fails).count(), columns, "{pattern}");
        let found = frames(vec![fault.clone()]);
        assert_eq!(found.len(), clean.len());
        for (place, (found, clean_frame)) in found.iter().zip(&clean).enumerate() {
            let acts = (40..=50).contains(&place);
            for ((found, usual), (before, fails)) in values(found)
                .into_iter()
                .zip(values(clean_frame))
                .zip(values(&clean[39]).into_iter().zip(&fault.columns))
            {
                let expected = match failure {
                    _ if !(acts && *fails) => usual,
                    Failure::Nan => Some(f32::NAN),
                    Failure::Infinity => Some(f32::INFINITY),
                    Failure::Outlier => Some(1.0e6),
                    Failure::Glitch => usual.map(|value| -3.0 * value),
                    Failure::Stuck => before,
                    Failure::Zero => Some(0.0),
                    Failure::Dropout | Failure::SkipFrames => None,
                };
                assert_eq!(found.map(f32::to_bits), expected.map(f32::to_bits), "{failure:?} {place}");
            }
        }
    }
}

#[test]
fn a_sensor_that_is_stuck_from_the_first_frame_on_repeats_that_one() {
    let found = frames(vec![Fault::new(Failure::Stuck, "gyro_*", (0.0, 5.0)).expect("a fault")]);
    let clean = frames(Vec::new());
    assert_ne!(clean[50].gyro_rad_s, clean[0].gyro_rad_s);
    assert!(found[..=50].iter().all(|frame| frame.gyro_rad_s == clean[0].gyro_rad_s));
    assert_eq!(found[51], clean[51]);
}

#[test]
fn skipped_frames_are_missing_and_repeated_ones_say_the_same() {
    let clean = frames(Vec::new());
    let skipped = frames(vec![Fault::parse(Failure::SkipFrames, "@2-3").expect("a fault")]);
    let times: Vec<u64> = skipped.iter().map(|frame| frame.time_us).collect();
    assert_eq!(skipped.len(), clean.len() - 11);
    assert_eq!(times[18..22], [1_800_000, 1_900_000, 3_100_000, 3_200_000]);
    assert_eq!(skipped[25], clean[36], "what comes after is as if nothing were missing");
    let repeat = FAILURES.iter().find(|(name, _)| *name == "repeat-frames").map(|(_, failure)| *failure);
    let repeated = frames(vec![Fault::parse(repeat.expect("known"), "@2-3").expect("a fault")]);
    assert_eq!(values(&repeated[30]), values(&clean[19]));
    assert_eq!(repeated[30].time_us, 3_000_000, "time goes on");
    assert_eq!(repeated[31], clean[31]);
}

#[test]
fn faults_are_written_as_the_help_says() {
    let one = Fault::parse(Failure::Nan, "accel_z_m_s2@7").expect("a fault");
    assert_eq!(one.between_s, (7.0, 7.0));
    assert!(one.acts_at(7.0) && !one.acts_at(6.9) && !one.acts_at(7.1));
    assert_eq!(one.columns.iter().position(|fails| *fails), names().iter().position(|name| name == "accel_z_m_s2"));
    for wrong in ["accel_z_m_s2", "accel@3", "gyro_*@5-4", "gyro_*@a-b", "gyro_*@", "@nan-3", "*_m_n@1"] {
        assert!(Fault::parse(Failure::Nan, wrong).is_err(), "{wrong}");
    }
}

/// Times are rounded to microseconds, those of the command line are as they are written.
#[test]
fn a_fault_between_two_frames_acts_on_none() {
    let acts = |between_s, frames, rate_hz| {
        Fault::new(Failure::Nan, "*", between_s).expect("a fault").acts_on_any(frames, rate_hz)
    };
    for (between_s, rate_hz) in
        [((0.0, 0.0), 10.0), ((3.3, 3.3), 10.0), ((0.333_333, 0.333_333), 3.0), ((2.95, 3.05), 10.0)]
    {
        assert!(acts(between_s, 61, rate_hz), "{between_s:?} at {rate_hz} Hz");
    }
    assert!(acts((-1.0, 0.0), 61, 10.0) && acts((6.0, 9.0), 61, 10.0) && acts((0.0, 9.0), 61, 10.0));
    for (between_s, rate_hz) in [((3.31, 3.39), 10.0), ((0.05, 0.05), 10.0), ((0.1, 0.3), 3.0), ((6.01, 9.0), 10.0)] {
        assert!(!acts(between_s, 61, rate_hz), "{between_s:?} at {rate_hz} Hz");
    }
}
