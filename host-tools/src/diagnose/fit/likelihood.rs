//! The marginal likelihood by Laplace's method.

use super::measured_latents::ln_stretch;
use super::model::{Coordinate, Derivatives};
use super::normal_equations::NormalEquations;
use super::observation::CHANNELS;
use super::problem::{Problem, RunRows};
use super::state::{Scales, State};

/// ln of the density of the readings at given parameters, latents and offsets integrated out to second order about a state
/// (Laplace's method; exact where the model is linear in them and no reading is an outlier). `equations` are those of the
/// state, undamped.
///
/// Of slip and load nothing is known but what the sensors read: their prior is flat in the readings, not in the true values.
/// An error of the sensors that shrinks the readings would else be paid for it in every row, with nothing explained
/// (a flat prior is one for one choice of scale only; Jeffreys 1946, Proc. R. Soc. A 186:453).
pub(super) fn log_likelihood(
    problem: &Problem<'_>,
    state: &State,
    scales: &Scales,
    objective: f64,
    equations: &NormalEquations,
) -> f64 {
    let ln_integral = problem.huber.ln_integral();
    let row_norm = |&index: &usize| -> f64 {
        let row = &problem.rows[index];
        let measured = (0..CHANNELS).filter(|&c| row.readings[c].is_some());
        measured.map(|c| scales.noise(row, c).ln() + ln_integral).sum()
    };
    // 2π of the latents' and the offsets' priors cancel with those of the integrals over them.
    let latent_norm: f64 = problem.options.latent_prior_std.iter().map(|std| std.ln()).sum();
    let run_norm = |(index, run): (usize, &RunRows)| -> f64 {
        let terms = &equations.runs[index];
        let offsets: f64 = (0..CHANNELS).filter(|&c| terms.active[c]).map(|c| scales.offset[c].ln()).sum();
        let rows: f64 = run.rows.iter().map(row_norm).sum();
        rows + latent_norm * run.rows.len() as f64 + offsets + 0.5 * terms.ln_det
    };
    let stretch = |(run, slopes): (&RunRows, &Vec<Derivatives>)| -> f64 {
        run.rows.iter().zip(slopes).map(|(&row, slopes)| ln_stretch(&problem.rows[row], slopes)).sum()
    };
    let norm: f64 = problem.runs.iter().enumerate().map(run_norm).sum();
    let stretched: f64 = problem.runs.iter().zip(state.slopes.iter()).map(stretch).sum();
    state.parameter_penalty(problem) - objective - norm + stretched
}

/// ln of the prior density of the parameters; a flat prior counts where its bounds are finite.
pub(super) fn log_prior(problem: &Problem<'_>, state: &State) -> f64 {
    let norm = |coordinate: &Coordinate| match coordinate.prior {
        Some((_, std)) => std.ln() + 0.5 * (2.0 * std::f64::consts::PI).ln(),
        None if coordinate.box_precision() > 0.0 => (coordinate.high - coordinate.low).ln(),
        None => 0.0,
    };
    -state.parameter_penalty(problem) - problem.coordinates().iter().map(norm).sum::<f64>()
}
