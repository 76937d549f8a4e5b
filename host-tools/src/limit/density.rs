//! What a sampler can be asked to sample.

use nalgebra::SVector;

/// A probability density that need not be normalised.
pub trait LogDensity<const D: usize> {
    /// What the density computes on its way and can start from at a point near by.
    type Latent: Clone;

    /// Logarithm of the density at `point`, and what to start from near there; none where the density is zero.
    ///
    /// The result must not depend on `near` beyond rounding.
    fn ln_density(&self, point: &SVector<f64, D>, near: &Self::Latent) -> Option<(f64, Self::Latent)>;

    /// What is kept of a draw: the point itself, or where it lies in other coordinates.
    fn kept(point: &SVector<f64, D>, _latent: &Self::Latent) -> SVector<f64, D> {
        *point
    }
}
