//! Noise that is taken larger while a fit is far from the data (deterministic annealing: Rose 1998, Proc. IEEE 86:2210).
//!
//! Where most readings of a channel lie in the tails of the loss, its slope says nothing of how far away the minimum is, and the
//! latents follow the readings to wherever the model can still go. With more noise than there is, both stay where they are known.

use super::observation::{CHANNELS, Reading};
use super::problem::Problem;
use super::state::{Scales, State};
use crate::statistics::sorted;

/// Factor on the noise of one round after that of the one before, at most.
const FALL: f64 = 0.2;

/// The factors on the noise of the judged channels, 1 or more.
#[derive(Debug, Clone, Copy)]
pub(super) struct Temper {
    factors: [f64; CHANNELS],
}

impl Temper {
    /// Such that half of the readings of each channel lie within the bulk of the loss.
    pub(super) fn of(problem: &Problem<'_>, state: &State, scales: &Scales) -> Self {
        let sizes = sizes(problem, state, scales);
        let mut factors = [1.0; CHANNELS];
        for reading in Reading::JUDGED {
            let sizes = sorted(sizes[reading.index()].iter().copied());
            let middle = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
            factors[reading.index()] = (middle / problem.options.huber).max(1.0);
        }
        Self { factors }
    }

    /// Whether any channel's noise is to be taken larger.
    pub(super) fn is_needed(&self) -> bool {
        self.factors.iter().any(|factor| *factor > 1.0)
    }

    /// As the state asks for now, but less than before.
    pub(super) fn falling_to(self, next: Self) -> Self {
        Self { factors: std::array::from_fn(|c| next.factors[c].min(FALL * self.factors[c]).max(1.0)) }
    }

    /// Noise and offsets so much larger.
    pub(super) fn apply(&self, scales: &Scales) -> Scales {
        Scales {
            noise: std::array::from_fn(|c| scales.noise[c] * self.factors[c]),
            offset: std::array::from_fn(|c| scales.offset[c] * self.factors[c]),
        }
    }
}

/// Sizes of each channel's residuals in units of noise.
fn sizes(problem: &Problem<'_>, state: &State, scales: &Scales) -> [Vec<f64>; CHANNELS] {
    let mut sizes: [Vec<f64>; CHANNELS] = Default::default();
    for (run, of_run) in problem.runs.iter().enumerate() {
        for (place, &row) in of_run.rows.iter().enumerate() {
            let standardised = state.standardised(&problem.rows[row], scales, run, place);
            sizes.iter_mut().zip(standardised).for_each(|(sizes, residual)| sizes.extend(residual.map(f64::abs)));
        }
    }
    sizes
}
