//! How far the noise of a row remembers that of the rows before.

use crate::statistics::autocorrelation::autocorrelation_time;

use super::observation::CHANNELS;
use super::outcome::Fit;

/// Standardised residual beyond which one counts as so large: an outlier is no memory.
const OUTLIER: f64 = 3.0;

impl Fit {
    /// How many rows of a run tell as much as an independent one, in the channel whose neighbours go together most; 1 where none go
    /// together more than independent noise does by chance. The fit takes noise for independent from row to row but for an offset of the
    /// run; where a sensor drifts, or the ground is not the same from place to place, rows say less than they seem to.
    pub fn rows_per_reading(&self) -> f64 {
        (0..CHANNELS).map(|channel| autocorrelation_time(self.series(channel))).fold(1.0, f64::max)
    }

    /// What the fit leaves of a channel about its mean, run by run.
    pub fn series(&self, channel: usize) -> Vec<Vec<f64>> {
        let rows: Vec<_> = self.rows.iter().zip(&self.standardised).collect();
        let runs = rows.chunk_by(|one, other| one.0.run == other.0.run);
        runs.map(|run| about_mean(run.iter().filter_map(|(_, left)| left[channel]).collect())).collect()
    }
}

fn about_mean(mut series: Vec<f64>) -> Vec<f64> {
    series.iter_mut().for_each(|value| *value = value.clamp(-OUTLIER, OUTLIER));
    let mean = series.iter().sum::<f64>() / series.len().max(1) as f64;
    series.iter_mut().for_each(|value| *value -= mean);
    series
}
