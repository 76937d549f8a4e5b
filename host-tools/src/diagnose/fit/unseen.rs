//! Runs that a fit does not see and is to predict.

use nalgebra::DVector;

use super::model::Latent;
use super::observation::Row;
use super::options::Options;
use super::problem::{Problem, RunRows, runs_of, within};
use super::start::Start;

/// A run that takes no part in a fit. Of its readings none counts, but that the wheel stood there under its load is known:
/// parameters by which the soil would not have carried it are none that the run can be predicted by.
pub(super) struct UnseenRun {
    run: RunRows,
    /// Slip and load as they were read.
    latents: Vec<Latent>,
}

impl UnseenRun {
    /// Those of some rows.
    pub(super) fn of(rows: &[Row], runs: &[usize], options: &Options) -> Vec<Self> {
        if runs.is_empty() {
            return Vec::new();
        }
        let read = Start::at(Vec::new(), rows).latents;
        let unseen =
            |run: RunRows| Self { latents: run.rows.iter().map(|&row| within(options, read[row])).collect(), run };
        runs_of(rows).into_iter().filter(|run| runs.contains(&run.id)).map(unseen).collect()
    }

    /// Whether the model says anything of the run with some parameters.
    pub(super) fn is_predicted(&self, problem: &Problem<'_>, parameters: &DVector<f64>) -> bool {
        problem.values(parameters, &self.run, &mut self.latents.clone()).is_some()
    }
}
