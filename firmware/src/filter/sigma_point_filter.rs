//! The filter: an estimate, and what it falls back to.

use crate::scalar::Scalar;

use super::spread::Factors;
use super::vector::{all_finite, diagonal, dot};
use super::{Gaussian, InvalidNumber, Spread};

/// A square-root sigma-point filter for a state of `N` numbers.
///
/// Mean and root stay finite whatever models and measurements do, except in [`SigmaPointFilter::take`]. Where a
/// factorisation overflows (standard deviations beyond about 1e18 in single precision, or numbers that are not finite), the
/// mean stays as it was, the root becomes the diagonal that was stated at construction, and that is counted and told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SigmaPointFilter<T, const N: usize> {
    pub(super) estimate: Gaussian<T, N>,
    pub(super) factors: Factors<T>,
    reset_std: [T; N],
    resets: u32,
}

impl<T: Scalar, const N: usize> SigmaPointFilter<T, N> {
    /// A filter that starts from `estimate`, with [`Spread::unit`]. `reset_std` are the standard deviations that it falls
    /// back to when a factorisation fails: large enough that it finds back from wherever its mean is then.
    ///
    /// # Errors
    /// Where a standard deviation is negative or its square not finite.
    pub fn new(estimate: Gaussian<T, N>, reset_std: [T; N]) -> Result<Self, InvalidNumber> {
        Self::with_spread(estimate, reset_std, Spread::unit())
    }

    /// As [`SigmaPointFilter::new`], with other sigma points.
    ///
    /// # Errors
    /// As [`SigmaPointFilter::new`].
    pub fn with_spread(estimate: Gaussian<T, N>, reset_std: [T; N], spread: Spread<T>) -> Result<Self, InvalidNumber> {
        Gaussian::independent(estimate.mean, reset_std)?;
        Ok(Self { estimate, factors: spread.factors::<N>(), reset_std, resets: 0 })
    }

    /// A filter that knows no more of its state than that it is `mean`, with independent standard deviations `std`, to which it falls back
    /// too. For numbers that were checked before: of others, one that is not finite counts as zero, and a deviation for its magnitude.
    pub fn unknowing(mean: [T; N], std: [T; N]) -> Self {
        let finite = |number: T| if number.is_finite() { number } else { T::zero() };
        let reset_std = std.map(|std| finite(std * std).sqrt());
        let estimate = Gaussian { mean: mean.map(finite), root: diagonal(&reset_std) };
        Self { estimate, factors: Spread::unit().factors::<N>(), reset_std, resets: 0 }
    }

    /// What is known of the state.
    pub fn estimate(&self) -> &Gaussian<T, N> {
        &self.estimate
    }

    /// Takes a measurement of a weighted sum of the states, as [`Gaussian::take`] does. It does not fall back: of numbers whose products
    /// overflow mean or root may come out not finite. The next prediction resets such a root, but not such a mean.
    pub fn take(&mut self, weights: &[T; N], measured: T, noise_variance: T) {
        self.estimate.take(weights, measured, noise_variance);
    }

    /// How often a factorisation has failed since construction.
    pub fn resets(&self) -> u32 {
        self.resets
    }

    /// Forgets what is known, and starts again from `estimate`. Does not clear [`SigmaPointFilter::resets`].
    pub fn restart(&mut self, estimate: Gaussian<T, N>) {
        self.estimate = estimate;
    }

    /// Ends a step that has written a new root: takes the mean that belongs to it, where root, mean and `witness`, another
    /// result of the same computation, are finite, and so is every variance that follows from the root. Else the mean stays and the root falls back to the stated diagonal.
    /// Gives whether it took the mean.
    #[must_use]
    pub(super) fn settle(&mut self, mean: [T; N], witness: T) -> bool {
        let root = self.estimate.root.as_flattened();
        let finite = dot(root, root).is_finite() && all_finite(&mean) && witness.is_finite();
        if finite {
            self.estimate.mean = mean;
        } else {
            self.fall_back();
        }
        finite
    }

    #[cold]
    fn fall_back(&mut self) {
        self.estimate.root = diagonal(&self.reset_std);
        self.resets = self.resets.saturating_add(1);
    }
}

#[cfg(test)]
mod tests {
    use super::SigmaPointFilter;

    #[test]
    fn a_filter_that_knows_nothing_holds_numbers_whatever_it_is_given() {
        let filter = SigmaPointFilter::<f64, 3>::unknowing([1.0, f64::NAN, 3.0], [0.5, 2.0, -4.0]);
        assert_eq!(*filter.estimate().mean(), [1.0, 0.0, 3.0]);
        assert_eq!(filter.estimate().stds(), [0.5, 2.0, 4.0]);
        let filter = SigmaPointFilter::<f32, 1>::unknowing([f32::INFINITY], [f32::NAN]);
        assert_eq!((*filter.estimate().mean(), filter.estimate().stds()), ([0.0], [0.0]));
    }
}
