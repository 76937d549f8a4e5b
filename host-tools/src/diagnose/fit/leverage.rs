//! How far each reading pulls its own prediction along.

use nalgebra::{DMatrix, DVector};

use super::model::Derivatives;
use super::normal_equations::NormalEquations;
use super::observation::{CHANNELS, ChannelMatrix, Channels, ParameterByChannel};
use super::problem::Problem;
use super::row_terms::RowTerms;
use super::run_terms::RunTerms;
use super::slices::add_times;
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
        let places = run.rows.iter().zip(&state.slopes[index]);
        places.map(|(row, slopes)| row_leverage(run, row, slopes, covariance)).collect()
    })
}

fn row_leverage(run: &RunTerms, row: &RowTerms, slopes: &Derivatives, covariance: &DMatrix<f64>) -> Channels {
    let by_parameter = ParameterByChannel::from_fn(run.following.nrows(), |p, c| {
        if row.weight[c] > 0.0 { slopes.by_parameter[p][c] - run.following[(p, c)] } else { 0.0 }
    });
    let shared = spread(covariance, &by_parameter) + run.offset_covariance;
    let unfollowed = row.unfollowed();
    let variance = (unfollowed * shared * unfollowed.transpose()).diagonal() + row.latent_variance();
    Channels::component_mul(&variance, &row.weight)
}

/// Covariance of the channels where the parameters have `covariance`. By columns: they are too short for anything cleverer.
pub(super) fn spread(covariance: &DMatrix<f64>, by_parameter: &ParameterByChannel) -> ChannelMatrix {
    let mut along = DVector::zeros(covariance.nrows());
    let mut spread = ChannelMatrix::zeros();
    for c in 0..CHANNELS {
        let by = by_parameter.column(c);
        if by.iter().all(|by| *by == 0.0) {
            continue;
        }
        along.fill(0.0);
        for (column, by) in covariance.column_iter().zip(by.iter()) {
            add_times(along.as_mut_slice(), *by, column.as_slice());
        }
        for d in 0..=c {
            spread[(c, d)] = by_parameter.column(d).dot(&along);
            spread[(d, c)] = spread[(c, d)];
        }
    }
    spread
}
