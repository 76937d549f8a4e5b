//! Standard deviations that the data have to tell: run offsets, and noise that nobody stated.
//!
//! At the maximum of the likelihood the mean square of what a standard deviation describes, in units of it, equals the degrees
//! of freedom that the data leave it (MacKay 1992, Neural Computation 4:415; the condition of Patterson & Thompson's restricted
//! likelihood when the parameters are integrated out as well). That is solved by iteration on the linear model about a state.

use nalgebra::DMatrix;

use super::leverage::{leverages, spread};
use super::normal_equations::NormalEquations;
use super::observation::{CHANNELS, Channels};
use super::options::{OffsetStd, VarianceCriterion};
use super::outcome::free_covariance;
use super::problem::Problem;
use super::row_terms::shift_by;
use super::run_terms::RunTerms;
use super::state::{Scales, State, Step};
use super::variance_share::{Share, VarianceShares};

/// Rounds of the iteration at one state.
const ROUNDS: usize = 12;
/// Slope of the log-likelihood along ln τ² or ln σ² at which it is at its maximum.
pub(super) const SETTLED: f64 = 5e-3;
/// First offset as a share of the noise.
const FIRST_OFFSET: f64 = 0.5;
/// Least offset as a share of the noise: none for all that it does.
const LEAST_OFFSET: f64 = 1e-3;
/// Least and greatest factor on the first guess of a noise.
const NOISE_FACTORS: (f64, f64) = (1e-2, 1e2);
/// Degrees of freedom below which a noise is not estimated.
const LEAST_FREEDOM: f64 = 0.5;

/// What to begin with.
pub(super) fn first_scales(problem: &Problem<'_>) -> Scales {
    let start = problem.scales_start.unwrap_or(Scales { noise: [1.0; CHANNELS], offset: [0.0; CHANNELS] });
    let offset = std::array::from_fn(|c| match problem.options.offsets[c] {
        OffsetStd::None => 0.0,
        OffsetStd::Known(std) => std,
        // Not less: the likelihood hardly changes with an offset that is nearly none, and a search would stay there.
        OffsetStd::Estimated => start.offset[c].max(FIRST_OFFSET * offset_unit(problem, c)),
    });
    let noise = std::array::from_fn(|c| if problem.options.estimate_noise[c] { start.noise[c] } else { 1.0 });
    Scales { noise, offset }
}

/// Whether anything is estimated here.
pub(super) fn are_estimated(problem: &Problem<'_>) -> bool {
    let offset =
        (0..CHANNELS).any(|c| problem.options.offsets[c] == OffsetStd::Estimated && offset_unit(problem, c) > 0.0);
    offset || problem.options.estimate_noise.contains(&true)
}

/// Mean noise of a channel in the runs that can have an offset; 0 without any.
fn offset_unit(problem: &Problem<'_>, channel: usize) -> f64 {
    let large = problem.runs.iter().filter(|run| run.rows.len() >= problem.options.smallest_run_with_offset);
    let rows = large.flat_map(|run| &run.rows).map(|&row| &problem.rows[row]);
    let noises: Vec<f64> = rows.filter(|row| row.readings[channel].is_some()).map(|row| row.noise[channel]).collect();
    if noises.is_empty() { 0.0 } else { noises.iter().sum::<f64>() / noises.len() as f64 }
}

/// Better standard deviations at a state, and the largest slope of the log-likelihood along the logarithm of a variance before.
pub(super) fn reestimate(problem: &Problem<'_>, state: &State, scales: &Scales) -> (Scales, f64) {
    let mut scales = *scales;
    let mut first_slope = None;
    let mut equations = NormalEquations::new(problem, state, &scales, 0.0);
    for round in 0..ROUNDS {
        if round > 0 {
            equations = equations.at_scales(problem, state, &scales);
        }
        let Some(shares) = shares(problem, state, &scales, &equations) else { break };
        let next = better(problem, &scales, &shares);
        let slope = largest_slope(problem, &scales, &next, &shares);
        first_slope.get_or_insert(slope);
        if slope < SETTLED {
            break;
        }
        scales = next;
    }
    (scales, first_slope.unwrap_or(0.0))
}

/// Standard deviations nearer to what the shares ask for.
pub(super) fn better(problem: &Problem<'_>, scales: &Scales, shares: &VarianceShares) -> Scales {
    let mut next = *scales;
    for c in 0..CHANNELS {
        if problem.options.offsets[c] == OffsetStd::Estimated && scales.offset[c] > 0.0 {
            let least = LEAST_OFFSET * offset_unit(problem, c);
            next.offset[c] = (scales.offset[c] * shares.offset[c].factor().sqrt()).max(least);
        }
        let noise = shares.noise[c];
        if problem.options.estimate_noise[c] && noise.freedom > LEAST_FREEDOM {
            // As if all that is left were free: what readings take part in determining has its share taken off already.
            let factor = Share { count: noise.freedom, ..noise }.factor().sqrt();
            next.noise[c] = (scales.noise[c] * factor).clamp(NOISE_FACTORS.0, NOISE_FACTORS.1);
        }
    }
    next
}

/// Largest slope of the log-likelihood along the logarithm of a variance that is not at the end of its range.
fn largest_slope(problem: &Problem<'_>, scales: &Scales, next: &Scales, shares: &VarianceShares) -> f64 {
    let mut largest: f64 = 0.0;
    for c in 0..CHANNELS {
        let least = LEAST_OFFSET * offset_unit(problem, c);
        if next.offset[c] != scales.offset[c] && next.offset[c].max(scales.offset[c]) > least {
            largest = largest.max(shares.offset[c].slope().abs());
        }
        if next.noise[c] != scales.noise[c] {
            largest = largest.max(shares.noise[c].slope().abs());
        }
    }
    largest
}

/// What all runs say of the variances, after the step to the minimum of the linear model about a state.
fn shares(
    problem: &Problem<'_>,
    state: &State,
    scales: &Scales,
    equations: &NormalEquations,
) -> Option<VarianceShares> {
    let step = equations.step(problem, state, 0.0)?;
    let runs = shares_by_run(problem, state, scales, equations, &step)?;
    Some(runs.iter().fold(VarianceShares::default(), |sum, run| sum + *run))
}

/// What each run says of the variances after a step of the linear model about a state.
pub(super) fn shares_by_run(
    problem: &Problem<'_>,
    state: &State,
    scales: &Scales,
    equations: &NormalEquations,
    step: &Step,
) -> Option<Vec<VarianceShares>> {
    let covariance = match problem.options.variance_criterion {
        VarianceCriterion::Restricted => free_covariance(problem, &(&state.parameters + &step.parameters), equations)?,
        VarianceCriterion::MaximumLikelihood => DMatrix::zeros(step.parameters.len(), step.parameters.len()),
    };
    let estimated = problem.options.estimate_noise;
    let leverages =
        if estimated.contains(&true) { leverages(problem, state, equations, &covariance) } else { Default::default() };
    let of_run = |index: usize| {
        let run = &equations.runs[index];
        let offset = state.offsets[index] + step.offsets[index];
        let mut shares =
            VarianceShares { offset: offset_shares(run, &offset, scales, &covariance), ..Default::default() };
        for (place, row) in run.rows.iter().enumerate().filter(|_| !leverages.is_empty()) {
            let shift = shift_by(&state.slopes[index][place], &row.weight, step.parameters.as_slice());
            let residual: Channels = row.residual_after(&(shift + step.offsets[index]), &step.latents[index][place]);
            for c in (0..CHANNELS).filter(|&c| row.weight[c] > 0.0 && estimated[c]) {
                shares.noise[c].squares += row.weight[c] * residual[c] * residual[c];
                shares.noise[c].freedom += 1.0 - leverages[index][place][c];
            }
        }
        shares
    };
    Some((0..equations.runs.len()).map(of_run).collect())
}

fn offset_shares(run: &RunTerms, offset: &Channels, scales: &Scales, covariance: &DMatrix<f64>) -> [Share; CHANNELS] {
    let spread = spread(covariance, &run.following);
    std::array::from_fn(|c| {
        if !run.active[c] {
            return Share::default();
        }
        let variance = scales.offset[c] * scales.offset[c];
        Share {
            squares: offset[c] * offset[c] / variance,
            freedom: 1.0 - (run.offset_covariance[(c, c)] + spread[(c, c)]) / variance,
            count: 1.0,
        }
    })
}
