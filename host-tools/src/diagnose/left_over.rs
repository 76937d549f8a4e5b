//! What a model leaves of a channel without following any column that was tried.
//!
//! A law that is missing need be none of the list, and need follow no column by a curve that turns at most twice. Then nothing
//! earns a place, and still the model does not explain the data. That is told, where the noise is stated, by what is left: it is
//! several times as much, and much the same in neighbouring rows, where noise is new in each. Noise that is stated too small is not the
//! same in neighbouring rows, noise that remembers is no larger than it is stated, and a gross error is neither.

use statrs::distribution::{ContinuousCDF, Normal};

use crate::statistics::autocorrelation::neighbours;
use crate::statistics::robust_std;

use super::chance::over_all;
use super::fit::Reading;
use super::measurements::Measurements;
use super::trial::Trial;

/// Times the stated noise from which something is left.
const TIMES_NOISE: f64 = 3.0;
/// Correlation of neighbours, about the mean of their run.
const ALIKE: f64 = 0.5;
/// The chance, over all channels, below which it is none.
const SIGNIFICANT: f64 = 1e-3;

/// What is left of a channel, along runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeftOver {
    /// The channel.
    pub channel: Reading,
    /// It over the stated noise.
    pub times_noise: f64,
    /// Share of what the model leaves of the channel.
    pub share_of_variance: f64,
    /// The chance that independent rows come out so, over all channels.
    pub p_value: f64,
}

/// What a model leaves of the channels whose noise is stated, the most first.
pub fn left_over(measurements: &Measurements, trial: &Trial<'_>) -> Vec<LeftOver> {
    let stated = |reading: &Reading| measurements.has(*reading) && measurements.noise[reading.index()].stated;
    let judged = Reading::JUDGED.into_iter().filter(stated);
    let found = judged.filter_map(|channel| along_runs(trial, channel));
    let mut found: Vec<_> = found.filter(|left| left.times_noise > TIMES_NOISE && left.p_value < SIGNIFICANT).collect();
    found.sort_by(|a, b| b.times_noise.total_cmp(&a.times_noise));
    found
}

/// Residuals, the offsets of the runs taken off, that are alike in neighbouring rows.
fn along_runs(trial: &Trial<'_>, channel: Reading) -> Option<LeftOver> {
    let left = trial.fit.standardised.iter().filter_map(|row| row[channel.index()]);
    let (correlation, pairs) = neighbours(&trial.fit.series(channel.index()));
    (correlation > ALIKE).then(|| LeftOver {
        channel,
        times_noise: robust_std(left),
        share_of_variance: correlation * correlation,
        p_value: over_all(Normal::standard().sf(correlation * pairs.sqrt()), Reading::JUDGED.len()),
    })
}
