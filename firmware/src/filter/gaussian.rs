//! What is known of a state: mean and covariance.

use crate::scalar::Scalar;

use super::vector::{all_finite, diagonal, dot};

/// A normal distribution of `N` numbers.
///
/// The covariance is held as a root: P = S Sᵀ. Every accessor computes from S, so no variance is negative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gaussian<T, const N: usize> {
    pub(super) mean: [T; N],
    /// The columns of S, which is any square root.
    pub(super) root: [[T; N]; N],
}

/// A number that no distribution can have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InvalidNumber {
    /// A mean is not finite.
    Mean,
    /// A standard deviation is negative, or the sum of their squares is not finite.
    StandardDeviation,
}

impl<T: Scalar, const N: usize> Gaussian<T, N> {
    /// Independent numbers with these means and standard deviations, each in the unit of its own number.
    ///
    /// # Errors
    /// Where a mean is not finite, or a standard deviation negative or the sum of their squares not.
    pub fn independent(mean: [T; N], std: [T; N]) -> Result<Self, InvalidNumber> {
        if !all_finite(&mean) {
            return Err(InvalidNumber::Mean);
        }
        if !(dot(&std, &std).is_finite() && std.iter().all(|value| *value >= T::zero())) {
            return Err(InvalidNumber::StandardDeviation);
        }
        Ok(Self { mean, root: diagonal(&std) })
    }

    /// The mean.
    pub fn mean(&self) -> &[T; N] {
        &self.mean
    }

    /// The variance of each number.
    pub fn variances(&self) -> [T; N] {
        let mut variances = [T::zero(); N];
        for column in &self.root {
            variances.iter_mut().zip(column).for_each(|(variance, entry)| *variance += *entry * *entry);
        }
        variances
    }

    /// The standard deviation of each number.
    pub fn stds(&self) -> [T; N] {
        self.variances().map(T::sqrt)
    }

    /// The covariance of two numbers, by their indices; `None` where there is no such number.
    pub fn covariance(&self, one: usize, other: usize) -> Option<T> {
        self.root.iter().try_fold(T::zero(), |sum, column| Some(sum + *column.get(one)? * *column.get(other)?))
    }

    /// Mean and variance of a weighted sum of the numbers, Σ wᵢ xᵢ.
    pub fn weighted_sum(&self, weights: &[T; N]) -> (T, T) {
        (dot(weights, &self.mean), self.variance_of_sum(weights))
    }

    /// Variance of a weighted sum of the numbers, Σ wᵢ xᵢ.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn variance_of_sum(&self, weights: &[T; N]) -> T {
        self.root.iter().map(|column| dot(weights, column)).fold(T::zero(), |total, entry| total + entry * entry)
    }

    /// Takes a measurement of a weighted sum of the numbers, Σ wᵢ xᵢ, whose noise has this variance, which must be positive.
    /// Nothing changes where the innovation over its variance, or the factor of what the root loses, is not finite. Of numbers whose products
    /// overflow that is no check: mean or root may then come out not finite.
    ///
    /// With f = Sᵀ w and a = f·f + r: K = S f/a, and the root becomes S − K fᵀ/(1 + √(r/a)) (Potter 1963; a factor, never a
    /// difference of covariances). For sums alone: a model that bends goes through [`SigmaPointFilter::update`].
    ///
    /// [`SigmaPointFilter::update`]: super::SigmaPointFilter::update
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn take(&mut self, weights: &[T; N], measured: T, noise_variance: T) {
        let slopes = self.root.each_ref().map(|column| dot(weights, column));
        let variance = dot(&slopes, &slopes) + noise_variance;
        let innovation = (measured - dot(weights, &self.mean)) / variance;
        let kept = T::one() / (variance + (noise_variance * variance).sqrt());
        if !(innovation.is_finite() && kept.is_finite()) {
            return;
        }
        let mut across = [T::zero(); N];
        for (column, slope) in self.root.iter().zip(&slopes) {
            across.iter_mut().zip(column).for_each(|(sum, entry)| *sum += *slope * *entry);
        }
        for (column, slope) in self.root.iter_mut().zip(&slopes) {
            column.iter_mut().zip(&across).for_each(|(entry, across)| *entry -= kept * *slope * *across);
        }
        self.mean.iter_mut().zip(&across).for_each(|(mean, across)| *mean += innovation * *across);
    }

    /// Covariance of two weighted sums of the numbers.
    pub fn covariance_of_sums(&self, one: &[T; N], other: &[T; N]) -> T {
        self.root.iter().fold(T::zero(), |sum, column| sum + dot(one, column) * dot(other, column))
    }
}
