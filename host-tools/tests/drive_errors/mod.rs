//! How far the estimates of a drive are from the truth.

use kapvik_firmware::rover::Rover;
use kapvik_firmware::sensor_frame::SensorFrame;
use kapvik_host::data::truth_file::Truth;
use kapvik_host::replay::naive::{TrailingMean, naive};
use kapvik_host::trial::WARM_UP_S;
use kapvik_host::trial::errors::Errors;

use crate::driven::driven;

/// Errors from the end of the warm-up on, beside those of the raw sensors: as those of a drive of the trials.
pub fn drive_errors(rover: &Rover<f64>, frames: &[(SensorFrame, Truth)]) -> Errors {
    let (said, _) = driven(rover, frames.iter().copied());
    let (mut errors, mut trailing) = (Errors::default(), TrailingMean::default());
    for ((estimate, truth), (frame, _)) in said.iter().zip(frames) {
        let now = naive(rover, frame);
        let second = trailing.push(frame.time_us, now);
        if frame.time_us as f64 * 1.0e-6 >= WARM_UP_S {
            errors.take(estimate, &now, &second, truth);
        }
    }
    errors
}
