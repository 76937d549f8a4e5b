//! Predictions of runs without their own help.

use nalgebra::DVector;

use super::bounds::bounded_step;
use super::held_out::HeldOut;
use super::model::Model;
use super::normal_equations::{bounded_covariance, with_floor};
use super::options::FitError;
use super::outcome::{Fit, fit_without};
use super::predictor::{Predictor, as_measured, predict};
use super::problem::Problem;
use super::variance_share::VarianceShares;
use super::variances::better;

/// Most halvings of the step away from the fit where the model predicts nothing after it.
const HALVINGS: usize = 4;

impl Fit {
    /// Runs predicted without their own help, by one Gauss–Newton step from this fit on the normal equations less the runs'
    /// contributions, and one like it for the standard deviations that were estimated: exact for a linear model without outliers
    /// whose standard deviations are known. `model` and
    /// its rows are those of the fit.
    ///
    /// # Errors
    /// [`FitError::NoRows`] if there are no such runs in the fit, or no others; [`FitError::UnfitStart`] for another model.
    pub fn leave_out(&self, model: &dyn Model, runs: &[usize]) -> Result<HeldOut, FitError> {
        self.left_out(&self.problem_of(model)?, runs)
    }

    /// The same for each of some runs in turn.
    ///
    /// # Errors
    /// As [`Fit::leave_out`].
    pub fn leave_each_out(
        &self,
        model: &dyn Model,
        runs: impl Iterator<Item = usize>,
    ) -> Result<Vec<HeldOut>, FitError> {
        let problem = self.problem_of(model)?;
        runs.map(|run| self.left_out(&problem, &[run])).collect()
    }

    fn left_out(&self, problem: &Problem<'_>, runs: &[usize]) -> Result<HeldOut, FitError> {
        if self.shares.iter().all(|share| runs.contains(&share.run)) {
            return Err(FitError::NoRows);
        }
        let mut information = self.information.clone();
        let mut pull = self.pull.clone();
        let mut variances = self.shares.iter().fold(VarianceShares::default(), |sum, share| sum + share.variances);
        for share in self.shares.iter().filter(|share| runs.contains(&share.run)) {
            information -= &share.information;
            pull -= &share.pull;
            variances = variances - share.variances;
        }
        let here = DVector::from_column_slice(&self.parameters);
        let (low, high) = problem.room(&here);
        let step = bounded_step(&with_floor(problem, &information), &pull, &low, &high)
            .unwrap_or_else(|| DVector::zeros(here.len()));
        let covariance = bounded_covariance(problem, &information).unwrap_or_else(|| self.covariance.clone());
        let scales = better(problem, &self.scales(), &variances);
        let predicted = |halvings: usize| {
            let parameters = &here + &step * 0.5_f64.powi(halvings as i32);
            let found = predict(problem, &scales, &parameters, &covariance, runs);
            found.iter().all(|run| run.log_score.is_some()).then_some((parameters, found))
        };
        let found = (0..=HALVINGS).find_map(predicted);
        let (parameters, found) = found.unwrap_or_else(|| {
            let found = predict(problem, &scales, &here, &covariance, runs);
            (here.clone(), found)
        });
        Ok(HeldOut { parameters: parameters.as_slice().to_vec(), runs: found })
    }

    /// The same by a new fit without the runs, from this one's parameters.
    ///
    /// # Errors
    /// See [`FitError`].
    pub fn leave_out_exact(&self, model: &dyn Model, runs: &[usize]) -> Result<HeldOut, FitError> {
        fit_without(model, &self.rows, runs, &self.onward(), &self.options)?.predict_unseen(model, runs)
    }

    /// Predictions of runs that this fit was made without. `model` and its rows are those of the fit.
    ///
    /// # Errors
    /// [`FitError::NoRows`] if the rows have no such run; [`FitError::UnfitStart`] for another model.
    pub fn predict_unseen(&self, model: &dyn Model, runs: &[usize]) -> Result<HeldOut, FitError> {
        let predictor = Predictor {
            parameters: self.parameters.clone(),
            covariance: self.covariance.clone(),
            scales: self.scales(),
        };
        let found = predictor.predict(model, &self.rows, &self.options, runs)?;
        Ok(HeldOut { parameters: self.parameters.clone(), runs: found })
    }

    fn problem_of<'a>(&'a self, model: &'a dyn Model) -> Result<Problem<'a>, FitError> {
        as_measured(model, &self.rows, &self.parameters, &self.options)
    }
}
