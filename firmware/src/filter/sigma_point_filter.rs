//! The filter: an estimate, and what it falls back to.

use crate::scalar::Scalar;

use super::gaussian::diagonal;
use super::spread::Factors;
use super::{Gaussian, InvalidNumber, Spread};

/// A square-root sigma-point filter for a state of `N` numbers.
///
/// Mean and root stay finite whatever models and measurements do. Where a factorisation overflows (standard deviations
/// beyond about 1e18 in single precision, or numbers that are not finite), the mean stays as it was, the root becomes the
/// diagonal that was stated at construction, and that is counted and told.
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
    /// Where a standard deviation is negative or not finite.
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

    /// What is known of the state.
    pub fn estimate(&self) -> &Gaussian<T, N> {
        &self.estimate
    }

    /// How often a factorisation has failed since construction.
    pub fn resets(&self) -> u32 {
        self.resets
    }

    /// Forgets what is known, and starts again from `estimate`. Does not clear [`SigmaPointFilter::resets`].
    pub fn restart(&mut self, estimate: Gaussian<T, N>) {
        self.estimate = estimate;
    }

    /// Takes a new estimate if it and `witness`, another result of the same computation, are finite; else falls back to the
    /// stated diagonal. Whether it was taken.
    #[must_use]
    pub(super) fn accept(&mut self, estimate: Gaussian<T, N>, witness: T) -> bool {
        let finite = estimate.is_finite() && witness.is_finite();
        if finite {
            self.estimate = estimate;
        } else {
            self.estimate.root = diagonal(&self.reset_std);
            self.resets = self.resets.saturating_add(1);
        }
        finite
    }
}
