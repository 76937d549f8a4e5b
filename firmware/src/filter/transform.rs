//! The unscented transform: what a model makes of a distribution.

use crate::scalar::Scalar;

use super::Gaussian;
use super::spread::Factors;

/// A model's outputs over the sigma points of a state of `N` numbers.
///
/// Of the two points m ± reach·Sᵢ along each column of the root it keeps half the difference of the outputs (the slope) and
/// half the sum less the output at the mean (the bend). With Y₀ the output at the mean, the transform's mean is Y₀ + Δ with
/// Δ = Σ bend/reach², and its covariance Σ (slope² + bend²)/reach² + (β − α²) ΔΔᵀ. Adding (√β − α) Δ/√N to each bend/reach
/// puts the last term into the sum of squares, so nothing is ever subtracted.
pub(super) struct Transformed<T, const N: usize, const M: usize> {
    /// The mean of each output.
    pub mean: [T; M],
    /// Of each output the slopes and the bends, both divided by the reach: the sum of their squares is its variance.
    pub deviations: [[[T; N]; 2]; M],
}

impl<T: Scalar, const N: usize, const M: usize> Transformed<T, N, M> {
    /// Evaluates `model` at 2 N + 1 points.
    #[inline]
    pub fn new(state: &Gaussian<T, N>, factors: &Factors<T>, model: &impl Fn(&[T; N]) -> [T; M]) -> Self {
        let centre = model(&state.mean);
        let mut deviations = [[[T::zero(); N]; 2]; M];
        let mut bend_sums = [T::zero(); M];
        for (index, column) in state.root.iter().enumerate() {
            let (mut ahead, mut behind) = (state.mean, state.mean);
            for ((ahead, behind), entry) in ahead.iter_mut().zip(&mut behind).zip(column) {
                let step = factors.reach * *entry;
                *ahead += step;
                *behind -= step;
            }
            let outputs = model(&ahead).into_iter().zip(model(&behind)).zip(&centre);
            for ((places, sum), ((ahead, behind), centre)) in deviations.iter_mut().zip(&mut bend_sums).zip(outputs) {
                let [slopes, bends] = places;
                if let (Some(slope), Some(bend)) = (slopes.get_mut(index), bends.get_mut(index)) {
                    *slope = (ahead - behind) * factors.half_inverse_reach;
                    // Each difference first: the outputs are large against how far they bend.
                    *bend = ((ahead - *centre) + (behind - *centre)) * factors.half_inverse_reach;
                    *sum += *bend;
                }
            }
        }
        let mut transformed = Self { mean: centre, deviations };
        transformed.shift(&bend_sums, factors);
        transformed
    }

    /// Moves the mean, and the bends by the share that the weight β asks for.
    #[inline]
    fn shift(&mut self, bend_sums: &[T; M], factors: &Factors<T>) {
        for ((mean, [_, bends]), sum) in self.mean.iter_mut().zip(&mut self.deviations).zip(bend_sums) {
            let shift = *sum * factors.inverse_reach;
            *mean += shift;
            let share = shift * factors.shift;
            bends.iter_mut().for_each(|bend| *bend += share);
        }
    }
}
