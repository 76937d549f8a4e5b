//! Whether innovations come in runs of one sign: then the state moves one way for longer than the filter thinks.
//!
//! Innovations of a filter that models its state well are white. Where the ground begins to rise, the state moves steadily,
//! each frame's innovation is small against its own spread, and only their mean over some frames stands out.

use crate::filter::Innovation;
use crate::scalar::Scalar;

/// Of the mean innovation, the share that is kept from frame to frame: over the last ten or so.
const KEPT: f64 = 0.85;
/// Variance of that mean in white noise of variance one.
const BY_CHANCE: f64 = (1.0 - KEPT) / (1.0 + KEPT);
/// No innovation counts for more standard deviations than this: one wild measurement is no run.
const GREATEST: f64 = 3.0;

/// The running means of some measurements' innovations, each in its standard deviations.
#[derive(Debug, Clone, Copy)]
pub(super) struct Runs<S, const N: usize> {
    means: [S; N],
}

impl<S: Scalar, const N: usize> Runs<S, N> {
    /// Nothing was seen.
    pub fn new() -> Self {
        Self { means: [S::zero(); N] }
    }

    /// Takes what an update told of the `N` measurements from the `first` on.
    pub fn take<const M: usize>(&mut self, told: &Innovation<S, M>, first: usize) {
        let (kept, greatest) = (S::constant(KEPT), S::constant(GREATEST));
        for (mean, residual) in self.means.iter_mut().zip(told.residuals.iter().skip(first)) {
            if let Some(innovation) = residual.normalised() {
                *mean = kept * *mean + (S::one() - kept) * innovation.max(-greatest).min(greatest);
            }
        }
    }

    /// By how much [`Self::over_chance`] is above a level that chance hardly reaches: nothing at first, all but two in the end. What
    /// has just passed the level is told by the last digits of single precision, and may not weigh yet.
    pub fn above(&self, level: f64) -> S {
        let above = (self.over_chance() - S::constant(level)).max(S::zero());
        above * above / (above + S::constant(2.0))
    }

    /// The running means, each in standard deviations of its innovations.
    pub fn means(&self) -> &[S; N] {
        &self.means
    }

    /// Mean of the squared means over what they are by chance: one, give or take, where innovations are white.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn over_chance(&self) -> S {
        let sum = self.means.iter().fold(S::zero(), |sum, mean| sum + *mean * *mean);
        sum * S::constant(1.0 / (BY_CHANCE * N as f64))
    }
}

#[cfg(test)]
mod tests {
    use super::Runs;
    use crate::filter::{Fate, Innovation, Residual};

    fn told(innovation: f64) -> Innovation<f64, 2> {
        let residual = Residual { fate: Fate::Used, innovation, std: 0.5 };
        Innovation { residuals: [Residual { innovation: 9.0, ..residual }, residual], ..Innovation::nothing() }
    }

    fn after_forty(sign: impl Fn(u32) -> f64) -> f64 {
        let mut runs = Runs::<f64, 1>::new();
        (0..40).for_each(|frame| runs.take(&told(0.5 * sign(frame)), 1));
        runs.over_chance()
    }

    /// Innovations of one standard deviation: in turn up and down they say nothing; all up, their mean is one, and by chance
    /// it would have a variance of (1 − 0.85)/(1 + 0.85).
    #[test]
    fn a_run_stands_out_and_what_goes_up_and_down_does_not() {
        assert!(after_forty(|frame| if frame.is_multiple_of(2) { 1.0 } else { -1.0 }) < 0.1);
        let run = after_forty(|_| 1.0);
        assert!((run - 1.85 / 0.15).abs() < 0.1, "{run}");
    }

    #[test]
    fn a_wild_measurement_is_no_run_and_a_missing_one_changes_nothing() {
        let mut runs = Runs::<f64, 1>::new();
        runs.take(&told(1.0e6), 1);
        let once = runs.over_chance();
        assert!(once < 4.0, "{once}");
        assert_eq!(runs.above(once + 0.1), 0.0);
        assert!((runs.above(once - 2.0) - 1.0).abs() < 1.0e-12);
        runs.take(&Innovation::<f64, 2>::nothing(), 1);
        assert_eq!(runs.over_chance(), once);
    }
}
