//! The normal distribution about a fit.

use crate::identification::least_squares::Triangle;
use crate::scalar::Scalar;

use super::problem::{Fit, Held};
use super::unknowns::{Point, UNKNOWNS};

/// The shared unknowns about a fit where some are held, to second order.
#[derive(Debug, Clone)]
pub(super) struct Normal<S> {
    triangle: Triangle<S, UNKNOWNS>,
    held: Held,
    /// Logarithm of what is left of the posterior density when the latents and all shared unknowns that are not held are
    /// integrated out.
    pub ln_evidence: S,
}

impl<S: Scalar> Normal<S> {
    /// About a fit.
    pub fn new<const N: usize>(fit: &Fit<S, N>, held: &Held) -> Self {
        let mut ln_evidence = S::constant(-0.5) * fit.cost;
        let all = fit.of_everything(S::zero(), |rows, latent| {
            ln_evidence += rows.ln_load_slope() - latent.ln_determinant();
        });
        let triangle = all.held(held);
        ln_evidence -= triangle.ln_determinant();
        Self { triangle, held: *held, ln_evidence }
    }

    /// Covariances of an unknown with all.
    pub fn covariances(&self, place: usize) -> Point<S> {
        self.triangle.covariances(place)
    }

    /// Variances; zero where an unknown is held.
    pub fn variances(&self) -> Point<S> {
        let mut variances = self.triangle.told_variances();
        for (variance, held) in variances.iter_mut().zip(&self.held) {
            if *held {
                *variance = S::zero();
            }
        }
        variances
    }
}
