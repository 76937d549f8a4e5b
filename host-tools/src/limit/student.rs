//! A multivariate Student distribution: the shape that a slice is cut from.

use nalgebra::{SMatrix, SVector};
use rand::RngExt;
use rand_distr::{Distribution, Gamma, StandardNormal};

/// Degrees of freedom: tails heavy enough for a posterior that is not quite normal.
const FREEDOM: f64 = 8.0;

/// Student's distribution in D dimensions, as a normal distribution of uncertain scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Student<const D: usize> {
    mean: SVector<f64, D>,
    /// Lower triangular root of the scale matrix.
    root: SMatrix<f64, D, D>,
}

impl<const D: usize> Student<D> {
    /// About zero, with the unit matrix for its scale.
    pub fn standard() -> Self {
        Self { mean: SVector::zeros(), root: SMatrix::identity() }
    }

    /// With a mean and a scale matrix; none where the matrix is not positive definite.
    pub fn new(mean: SVector<f64, D>, scale: SMatrix<f64, D, D>) -> Option<Self> {
        Some(Self { mean, root: scale.cholesky()?.unpack() })
    }

    /// With the mean and covariance of some points; none where they do not span the space.
    pub fn fitted(points: &[SVector<f64, D>]) -> Option<Self> {
        let count = points.len() as f64;
        let mean = points.iter().sum::<SVector<f64, D>>() / count;
        let squares: SMatrix<f64, D, D> = points.iter().map(|point| (point - mean) * (point - mean).transpose()).sum();
        Self::new(mean, squares * ((FREEDOM - 2.0) / FREEDOM / count))
    }

    /// Logarithm of the density, but for a constant.
    pub fn ln_density(&self, point: &SVector<f64, D>) -> f64 {
        -0.5 * (FREEDOM + D as f64) * libm::log1p(self.distance_squared(point) / FREEDOM)
    }

    /// A point of its own.
    pub fn draw(&self, random: &mut impl RngExt) -> SVector<f64, D> {
        self.mean + self.deviate(gamma(FREEDOM / 2.0, FREEDOM / 2.0, random), random)
    }

    /// The mean.
    pub fn mean(&self) -> &SVector<f64, D> {
        &self.mean
    }

    /// A second point of the normal distribution that `point` may have come from, less the mean.
    pub fn companion(&self, point: &SVector<f64, D>, random: &mut impl RngExt) -> SVector<f64, D> {
        let (shape, rate) = (0.5 * (FREEDOM + D as f64), 0.5 * (FREEDOM + self.distance_squared(point)));
        self.deviate(gamma(shape, rate, random), random)
    }

    fn deviate(&self, precision: f64, random: &mut impl RngExt) -> SVector<f64, D> {
        let normal = SVector::from_fn(|_, _| StandardNormal.sample(random));
        self.root * normal / libm::sqrt(precision)
    }

    fn distance_squared(&self, point: &SVector<f64, D>) -> f64 {
        let whitened = self.root.solve_lower_triangular(&(point - self.mean));
        whitened.map_or(f64::INFINITY, |whitened| whitened.norm_squared())
    }
}

fn gamma(shape: f64, rate: f64, random: &mut impl RngExt) -> f64 {
    // Both are positive and finite here, which is all that the constructor asks.
    Gamma::new(shape, 1.0 / rate).map_or(1.0, |gamma| gamma.sample(random))
}
