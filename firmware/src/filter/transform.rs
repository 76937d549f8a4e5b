//! The unscented transform: what a model makes of a distribution.

use crate::scalar::Scalar;

use super::Gaussian;
use super::spread::Factors;
use super::vector::all_finite;

/// An output of a model over the sigma points of a state of `N` numbers.
///
/// Of the two points m ± reach·Sᵢ along each column of the root it keeps half the difference of the outputs (the slope) and
/// half the sum less the output at the mean (the bend). With y₀ the output at the mean, the transform's mean is y₀ + Δ with
/// Δ = Σ bend/reach², and its covariance Σ (slope² + bend²)/reach² + (β − α²) ΔΔᵀ. Adding (√β − α) Δ/√N to each bend/reach
/// puts the last term into the sum of squares, so nothing is ever subtracted.
#[derive(Clone, Copy)]
pub(super) struct Output<T, const N: usize> {
    /// The mean.
    pub mean: T,
    /// The slopes and the bends, divided by the reach: the sum of their squares is the variance.
    pub deviations: [[T; N]; 2],
}

/// The outputs of `model`, evaluated at 2 N + 1 points, written to `outputs`.
#[inline]
pub(super) fn transform<T: Scalar, const N: usize, const M: usize>(
    state: &Gaussian<T, N>,
    factors: &Factors<T>,
    model: &impl Fn(&[T; N]) -> [T; M],
    outputs: &mut [Output<T, N>; M],
) {
    outputs.iter_mut().zip(model(&state.mean)).for_each(|(output, centre)| output.mean = centre);
    for (index, column) in state.root.iter().enumerate() {
        let (mut ahead, mut behind) = (state.mean, state.mean);
        for ((ahead, behind), entry) in ahead.iter_mut().zip(&mut behind).zip(column) {
            let step = factors.reach * *entry;
            *ahead += step;
            *behind -= step;
        }
        let pairs = model(&ahead).into_iter().zip(model(&behind));
        for (output, (ahead, behind)) in outputs.iter_mut().zip(pairs) {
            let [slopes, bends] = &mut output.deviations;
            if let (Some(slope), Some(bend)) = (slopes.get_mut(index), bends.get_mut(index)) {
                *slope = (ahead - behind) * factors.half_inverse_reach;
                // Each difference first: the outputs are large against how far they bend.
                *bend = ((ahead - output.mean) + (behind - output.mean)) * factors.half_inverse_reach;
            }
        }
    }
    outputs.iter_mut().for_each(|output| output.shift(factors));
}

impl<T: Scalar, const N: usize> Output<T, N> {
    /// All zero, to be written.
    pub fn blank() -> Self {
        Self { mean: T::zero(), deviations: [[T::zero(); N]; 2] }
    }

    /// Whether every number in it is finite.
    pub fn is_finite(&self) -> bool {
        self.mean.is_finite() && all_finite(self.deviations.as_flattened())
    }

    /// Its deviations, all in one row.
    pub fn rows(&mut self) -> &mut [T] {
        self.deviations.as_flattened_mut()
    }

    /// Moves the mean from the output at the mean to the mean output, and the bends by what the weight β asks for.
    #[inline]
    fn shift(&mut self, factors: &Factors<T>) {
        let [_, bends] = &mut self.deviations;
        let shift = bends.iter().fold(T::zero(), |sum, bend| sum + *bend) * factors.inverse_reach;
        self.mean += shift;
        let share = shift * factors.shift;
        bends.iter_mut().for_each(|bend| *bend += share);
    }
}
