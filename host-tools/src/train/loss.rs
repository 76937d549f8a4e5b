//! Gaussian negative log-likelihood of the targets under the predicted means and variances.
//!
//! Its minimum is the posterior mean and the posterior variance, whatever the shape of the posterior.

use kapvik_firmware::network::{OUTPUTS, TARGETS};

/// Bounds of a predicted log-variance on the scale of the prior.
pub const LOG_VARIANCE: (f32, f32) = (-14.0, 2.0);

/// A loss: from outputs and target to the loss of one example and its slope against each output.
pub type Loss = fn(&[f32; OUTPUTS], &[f32; TARGETS]) -> (f32, [f32; OUTPUTS]);

/// Mean square error of the means alone, for comparison with libraries that know no other loss.
pub fn mean_square(outputs: &[f32; OUTPUTS], target: &[f32; TARGETS]) -> (f32, [f32; OUTPUTS]) {
    let share = 1.0 / TARGETS as f32;
    let mut loss = 0.0;
    let mut slope = [0.0; OUTPUTS];
    for k in 0..TARGETS {
        let error = outputs[k] - target[k];
        loss += share * error * error;
        slope[k] = 2.0 * share * error;
    }
    (loss, slope)
}

/// Negative log-likelihood of one example, and its slope against each output. Beyond [`LOG_VARIANCE`] the loss does not follow a
/// log-variance, and the slope against it stays that at the bound, so that an output can find back.
pub fn gaussian(outputs: &[f32; OUTPUTS], target: &[f32; TARGETS]) -> (f32, [f32; OUTPUTS]) {
    let mut loss = 0.0;
    let mut slope = [0.0; OUTPUTS];
    for k in 0..TARGETS {
        let error = outputs[k] - target[k];
        let log_variance = outputs[TARGETS + k].clamp(LOG_VARIANCE.0, LOG_VARIANCE.1);
        let precision = libm::expf(-log_variance);
        loss += 0.5 * (log_variance + error * error * precision);
        slope[k] = error * precision;
        slope[TARGETS + k] = 0.5 * (1.0 - error * error * precision);
    }
    (loss, slope)
}

/// Fisher's information of each output: the precision for a mean, one half for a log-variance.
pub fn fisher(outputs: &[f32; OUTPUTS]) -> [f32; OUTPUTS] {
    std::array::from_fn(|k| match outputs.get(k + TARGETS) {
        Some(&log_variance) => libm::expf(-log_variance.clamp(LOG_VARIANCE.0, LOG_VARIANCE.1)),
        None => 0.5,
    })
}
