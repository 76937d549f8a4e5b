//! Noise that is taken larger while a fit is far from the data (deterministic annealing: Rose 1998, Proc. IEEE 86:2210).
//!
//! Where most readings of a channel lie in the tails of the loss, its slope says nothing of how far away the minimum is, and the
//! latents follow the readings to wherever the model can still go. With more noise than there is, both stay where they are known.

use super::observation::{CHANNELS, Reading};
use super::problem::Problem;
use super::state::{Scales, State};

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
        let mut factors = [1.0; CHANNELS];
        for reading in Reading::JUDGED {
            let c = reading.index();
            factors[c] = (median_size(problem, state, scales, c) / problem.options.huber).max(1.0);
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

/// Median size of a channel's residuals in units of noise; 0 without any.
fn median_size(problem: &Problem<'_>, state: &State, scales: &Scales, channel: usize) -> f64 {
    let rows = problem.runs.iter().enumerate().flat_map(|(run, of_run)| {
        of_run.rows.iter().enumerate().filter_map(move |(place, &row)| {
            state.standardised(&problem.rows[row], scales, run, place)[channel].map(f64::abs)
        })
    });
    let mut sizes: Vec<f64> = rows.collect();
    if sizes.is_empty() {
        return 0.0;
    }
    let middle = sizes.len() / 2;
    *sizes.select_nth_unstable_by(middle, f64::total_cmp).1
}
