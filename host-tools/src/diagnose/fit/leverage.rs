//! How far each reading pulls its own prediction along.

use nalgebra::DMatrix;

use super::model::Prediction;
use super::normal_equations::NormalEquations;
use super::observation::{ChannelMatrix, Channels, ParameterByChannel};
use super::problem::Problem;
use super::row_terms::RowTerms;
use super::run_terms::RunTerms;
use super::state::State;

/// Variance of what the fit expects of each reading, offset included, times the reading's weight: its share of the degrees of
/// freedom, 0 to 1. By run and row; 0 where not measured. `covariance` of the parameters, zero where they are held.
pub(super) fn leverages(
    problem: &Problem<'_>,
    state: &State,
    equations: &NormalEquations,
    covariance: &DMatrix<f64>,
) -> Vec<Vec<Channels>> {
    problem.by_run(|index, _| {
        let run = &equations.runs[index];
        // With the parameters the offsets move by −S⁻¹Nᵀ.
        let following = &run.cross * run.offset_covariance;
        let places = run.rows.iter().zip(&state.predictions[index]);
        places.map(|(row, prediction)| row_leverage(run, row, prediction, &following, covariance)).collect()
    })
}

fn row_leverage(
    run: &RunTerms,
    row: &RowTerms,
    prediction: &Prediction,
    following: &ParameterByChannel,
    covariance: &DMatrix<f64>,
) -> Channels {
    let by_parameter = ParameterByChannel::from_fn(following.nrows(), |p, c| {
        if row.weight[c] > 0.0 { prediction.by_parameter[p][c] - following[(p, c)] } else { 0.0 }
    });
    let spread = by_parameter.tr_mul(&(covariance * &by_parameter));
    let shared = ChannelMatrix::from_fn(|c, d| spread[(c, d)]) + run.offset_covariance;
    let unfollowed = row.unfollowed();
    let variance = (unfollowed * shared * unfollowed.transpose()).diagonal() + row.latent_variance();
    Channels::component_mul(&variance, &row.weight)
}
