//! What a fit says of runs that it has not seen.

use super::observation::CHANNELS;

/// Predictions of runs by a fit that has not seen them.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldOut {
    /// The parameters that they were predicted with.
    pub parameters: Vec<f64>,
    /// One per run, in the order asked for.
    pub runs: Vec<HeldOutRun>,
}

impl HeldOut {
    /// Sum of the runs' log scores; none where a run could not be predicted.
    pub fn log_score(&self) -> Option<f64> {
        self.runs.iter().map(|run| run.log_score).sum()
    }
}

/// Prediction of one run.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldOutRun {
    /// The run's number.
    pub run: usize,
    /// ln of the joint predictive density of all readings that were judged; none where the model predicts nothing for the run.
    pub log_score: Option<f64>,
    /// Its rows, in order.
    pub rows: Vec<HeldOutRow>,
}

impl HeldOutRun {
    /// Of a run that a model says nothing of.
    pub fn without_answer(run: usize) -> Self {
        Self { run, log_score: None, rows: Vec::new() }
    }
}

/// Prediction of one row from its slip and load. Slip and load themselves are never judged, nor is what stood in for a load; of a load whose
/// sinkage is measured, too, the residual is that of the load which this sinkage asks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeldOutRow {
    /// Index of the row.
    pub row: usize,
    /// Measured less predicted in the channel's unit, the run's unknown offset not taken off.
    pub residual: [Option<f64>; CHANNELS],
    /// Standard deviation that the prediction gives this residual: parameters, slip and load, offset and noise.
    pub std: [Option<f64>; CHANNELS],
    /// The same where the run's offsets are known.
    pub std_within_run: [Option<f64>; CHANNELS],
}
