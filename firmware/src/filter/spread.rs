//! How far the sigma points lie from the mean, and what they weigh.

use crate::scalar::Scalar;

/// The two parameters of the scaled unscented transform (its third, κ, is zero).
///
/// No sigma point gets a negative weight: the transform is written in differences of pairs, where α² ≤ 1 and β ≥ 0 make
/// every term of a covariance a square.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread<T> {
    alpha: T,
    beta: T,
}

impl<T: Scalar> Spread<T> {
    /// α = 1, β = 2: points at ±√N standard deviations, and the variance of a squared normal number exact.
    pub fn unit() -> Self {
        Self { alpha: T::one(), beta: T::constant(2.0) }
    }

    /// Points at ±α√N standard deviations, 0.01 ≤ α ≤ 1, and the weight β ≥ 0 of the centre. `None` outside these bounds:
    /// below 0.01 the differences between points drown in the rounding of single precision.
    pub fn new(alpha: T, beta: T) -> Option<Self> {
        let valid = alpha >= T::constant(0.01) && alpha <= T::one() && beta >= T::zero() && beta.is_finite();
        valid.then_some(Self { alpha, beta })
    }

    /// The factors that a transform of a state of `N` numbers works with.
    pub(super) fn factors<const N: usize>(&self) -> Factors<T> {
        let root_n = T::constant(N as f64).sqrt();
        let reach = self.alpha * root_n;
        Factors {
            reach,
            inverse_reach: T::one() / reach,
            half_inverse_reach: T::constant(0.5) / reach,
            shift: (self.beta.sqrt() - self.alpha) / root_n,
        }
    }
}

/// What follows from a [`Spread`] for one size of state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Factors<T> {
    /// α√N: from the mean to a point, in columns of the root.
    pub reach: T,
    pub inverse_reach: T,
    pub half_inverse_reach: T,
    /// (√β − α)/√N: the share of the mean's shift that is added to every bend, see [`super::transform`].
    pub shift: T,
}
