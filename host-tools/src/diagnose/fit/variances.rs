//! Standard deviations that the data have to tell: run offsets, and noise that nobody stated.
//!
//! At the maximum of the likelihood the mean square of what a standard deviation describes, in units of it, equals the degrees
//! of freedom that the data leave it (MacKay 1992, Neural Computation 4:415; the condition of Patterson & Thompson's restricted
//! likelihood when the parameters are integrated out as well). That is solved by iteration on the linear model about a state.

use nalgebra::DMatrix;

use super::leverage::leverages;
use super::normal_equations::NormalEquations;
use super::observation::{CHANNELS, Channels};
use super::options::{OffsetStd, VarianceCriterion};
use super::outcome::free_covariance;
use super::problem::Problem;
use super::row_terms::shift_by;
use super::state::{Scales, State};

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
/// Largest factor on a variance in one round.
const LARGEST_CHANGE: f64 = 10.0;
/// Power of the ratio by which a variance changes, at most: fast where the data hardly inform it.
const LARGEST_POWER: f64 = 5.0;
/// Degrees of freedom below which a noise is not estimated.
const LEAST_FREEDOM: f64 = 0.5;

/// What to begin with.
pub(super) fn first_scales(problem: &Problem<'_>) -> Scales {
    let offset = std::array::from_fn(|c| match problem.options.offsets[c] {
        OffsetStd::None => 0.0,
        OffsetStd::Known(std) => std,
        OffsetStd::Estimated => FIRST_OFFSET * offset_unit(problem, c),
    });
    Scales { noise: [1.0; CHANNELS], offset }
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

/// Mean squares in units of the variances, the degrees of freedom that are left to them, and how many there are.
#[derive(Default, Clone, Copy)]
struct Share {
    squares: f64,
    freedom: f64,
    count: f64,
}

impl Share {
    fn slope(&self) -> f64 {
        0.5 * (self.squares - self.freedom)
    }

    /// Factor on the variance; a Newton step along its logarithm where the ratio falls like a power of it.
    fn factor(&self) -> f64 {
        if self.freedom <= 0.0 || self.count <= 0.0 {
            return 1.0;
        }
        let power = (self.count / self.freedom).clamp(1.0, LARGEST_POWER);
        (self.squares / self.freedom).powf(power).clamp(1.0 / LARGEST_CHANGE, LARGEST_CHANGE)
    }
}

/// Better standard deviations at a state, and the largest slope of the log-likelihood along the logarithm of a variance before.
pub(super) fn reestimate(problem: &Problem<'_>, state: &State, scales: &Scales) -> (Scales, f64) {
    let mut scales = *scales;
    let mut first_slope = None;
    for _ in 0..ROUNDS {
        let Some((offsets, noises)) = shares(problem, state, &scales) else { break };
        let mut largest: f64 = 0.0;
        let mut next = scales;
        for c in 0..CHANNELS {
            if problem.options.offsets[c] == OffsetStd::Estimated && scales.offset[c] > 0.0 {
                let least = LEAST_OFFSET * offset_unit(problem, c);
                next.offset[c] = (scales.offset[c] * offsets[c].factor().sqrt()).max(least);
                if next.offset[c] > least || scales.offset[c] > least {
                    largest = largest.max(offsets[c].slope().abs());
                }
            }
            if problem.options.estimate_noise[c] && noises[c].freedom > LEAST_FREEDOM {
                let factor = Share { count: noises[c].freedom, ..noises[c] }.factor().sqrt();
                next.noise[c] = (scales.noise[c] * factor).clamp(NOISE_FACTORS.0, NOISE_FACTORS.1);
                if next.noise[c] != scales.noise[c] {
                    largest = largest.max(noises[c].slope().abs());
                }
            }
        }
        first_slope.get_or_insert(largest);
        if largest < SETTLED {
            break;
        }
        scales = next;
    }
    (scales, first_slope.unwrap_or(0.0))
}

/// Shares of the offsets and of the noise of each channel, after the step to the minimum of the linear model about a state.
fn shares(problem: &Problem<'_>, state: &State, scales: &Scales) -> Option<([Share; CHANNELS], [Share; CHANNELS])> {
    let equations = NormalEquations::new(problem, state, scales, 0.0);
    let step = equations.step(problem, state, 0.0)?;
    let covariance = match problem.options.variance_criterion {
        VarianceCriterion::Restricted => free_covariance(problem, &(&state.parameters + &step.parameters), &equations)?,
        VarianceCriterion::MaximumLikelihood => DMatrix::zeros(step.parameters.len(), step.parameters.len()),
    };
    let leverages = leverages(problem, state, &equations, &covariance);
    let mut offsets = [Share::default(); CHANNELS];
    let mut noises = [Share::default(); CHANNELS];
    for (index, run) in equations.runs.iter().enumerate() {
        let gain = &run.cross * run.offset_covariance;
        let spread = gain.tr_mul(&(&covariance * &gain));
        let offset = state.offsets[index] + step.offsets[index];
        for c in (0..CHANNELS).filter(|&c| run.active[c]) {
            let variance = scales.offset[c] * scales.offset[c];
            offsets[c].squares += offset[c] * offset[c] / variance;
            offsets[c].freedom += 1.0 - (run.offset_covariance[(c, c)] + spread[(c, c)]) / variance;
            offsets[c].count += 1.0;
        }
        for (place, row) in run.rows.iter().enumerate() {
            let shift = shift_by(&state.predictions[index][place], &row.weight, step.parameters.as_slice());
            let residual: Channels = row.residual_after(&(shift + step.offsets[index]), &step.latents[index][place]);
            for c in (0..CHANNELS).filter(|&c| row.weight[c] > 0.0) {
                noises[c].squares += row.weight[c] * residual[c] * residual[c];
                noises[c].freedom += 1.0 - leverages[index][place][c];
                noises[c].count += 1.0;
            }
        }
    }
    Some((offsets, noises))
}
