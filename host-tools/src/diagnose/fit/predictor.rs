//! A fit as far as it predicts runs that it has not seen.

use nalgebra::{DMatrix, DVector};

use super::held_out::HeldOutRun;
use super::levenberg_marquardt::Optimum;
use super::measured_latents::measured_run;
use super::model::Model;
use super::normal_equations::NormalEquations;
use super::observation::Row;
use super::options::{FitError, Options};
use super::outcome::{covariance, optimum, used_offsets};
use super::predictive::judge;
use super::problem::Problem;
use super::start::Start;
use super::state::Scales;

/// What predictions of unseen runs take of a fit.
#[derive(Debug, Clone)]
pub struct Predictor {
    /// The mode.
    pub(super) parameters: Vec<f64>,
    /// Covariance of the parameters.
    pub(super) covariance: DMatrix<f64>,
    /// Standard deviations of noise and offsets.
    pub(super) scales: Scales,
}

/// That of a fit to all rows but those of some runs, without what else a [`super::Fit`] says.
///
/// # Errors
/// See [`FitError`].
pub fn predictor_without(
    model: &dyn Model,
    rows: &[Row],
    without: &[usize],
    start: &Start,
    options: &Options,
) -> Result<Predictor, FitError> {
    let problem = Problem::new(model, rows, without, start, options)?;
    let Optimum { state, scales, .. } = optimum(&problem, start)?;
    let equations = NormalEquations::new(&problem, &state, &scales, 0.0);
    Ok(Predictor {
        parameters: state.parameters.as_slice().to_vec(),
        covariance: covariance(&problem, &equations),
        scales: Scales { offset: used_offsets(&equations, &scales), ..scales },
    })
}

impl Predictor {
    /// Predictions of some runs of the rows, from slip and load as they were measured: nothing of a fit's own latents may reach
    /// a prediction.
    ///
    /// # Errors
    /// [`FitError::NoRows`] if the rows have no such run; [`FitError::UnfitStart`] for another model.
    pub fn predict(
        &self,
        model: &dyn Model,
        rows: &[Row],
        options: &Options,
        runs: &[usize],
    ) -> Result<Vec<HeldOutRun>, FitError> {
        let problem = as_measured(model, rows, &self.parameters, options)?;
        let parameters = DVector::from_column_slice(&self.parameters);
        let found = predict(&problem, &self.scales, &parameters, &self.covariance, runs);
        if found.is_empty() { Err(FitError::NoRows) } else { Ok(found) }
    }
}

/// All rows, latents as measured.
pub(super) fn as_measured<'a>(
    model: &'a dyn Model,
    rows: &'a [Row],
    parameters: &[f64],
    options: &'a Options,
) -> Result<Problem<'a>, FitError> {
    Problem::new(model, rows, &[], &Start::at(parameters.to_vec(), rows), options)
}

pub(super) fn predict(
    problem: &Problem<'_>,
    scales: &Scales,
    parameters: &DVector<f64>,
    covariance: &DMatrix<f64>,
    runs: &[usize],
) -> Vec<HeldOutRun> {
    let of_run = |id: &usize| problem.runs.iter().find(|run| run.id == *id);
    let predict = |run| match measured_run(problem, parameters, run) {
        Some(measured) => judge(problem, scales, covariance, run, &measured),
        None => HeldOutRun::without_answer(run.id),
    };
    runs.iter().filter_map(of_run).map(predict).collect()
}
