//! Generalised elliptical slice sampling: a step of a Markov chain that needs no tuning and never stands still.
//!
//! R. Nishihara, I. Murray, R. P. Adams, "Parallel MCMC with generalized elliptical slice sampling", Journal of Machine
//! Learning Research 15 (2014) 2087–2112. The density is written as a Student distribution times a rest; where the fit is
//! good the rest is flat and a step is an independent draw, and where it is not the step is still exact.

use nalgebra::SVector;
use rand::RngExt;

use super::density::LogDensity;
use super::student::Student;

/// Where a chain is.
#[derive(Debug, Clone)]
pub struct Walker<const D: usize, L> {
    /// The point.
    pub point: SVector<f64, D>,
    /// Logarithm of the density there, but for a constant.
    pub ln_density: f64,
    /// What the density can start from near there.
    pub latent: L,
}

/// Shrinkings after which a bracket holds nothing but the point itself, to rounding.
const SHRINKINGS: usize = 200;

/// One step. Returns how often the density was evaluated.
pub fn step<const D: usize, T: LogDensity<D>>(
    density: &T,
    student: &Student<D>,
    walker: &mut Walker<D, T::Latent>,
    random: &mut impl RngExt,
) -> usize {
    let companion = student.companion(&walker.point, random);
    let from = walker.point - student.mean();
    let height: f64 = 1.0 - random.random::<f64>();
    let threshold = walker.ln_density - student.ln_density(&walker.point) + libm::log(height);
    let mut angle = std::f64::consts::TAU * random.random::<f64>();
    let (mut low, mut high) = (angle - std::f64::consts::TAU, angle);
    for evaluation in 1..=SHRINKINGS {
        let (sin, cos) = libm::sincos(angle);
        let point = student.mean() + from * cos + companion * sin;
        if let Some((ln_density, latent)) = density.ln_density(&point, &walker.latent)
            && ln_density - student.ln_density(&point) > threshold
        {
            *walker = Walker { point, ln_density, latent };
            return evaluation;
        }
        if angle < 0.0 {
            low = angle;
        } else {
            high = angle;
        }
        angle = low + (high - low) * random.random::<f64>();
    }
    SHRINKINGS
}
