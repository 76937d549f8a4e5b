//! Coordinates in which the posterior is nearly the standard normal distribution, however bent its ridges are.
//!
//! Let r(x) be the residuals of prior and likelihood, whitened once and for all, and Q an orthonormal basis of the columns of
//! their Jacobian at the mode. The coordinates are u = Qᵀ r(x). The map is that of J. M. Bardsley, A. Solonen, H. Haario,
//! M. Laine, "Randomize-then-optimize", SIAM Journal on Scientific Computing 36 (2014) A1895–A1910; here it only changes
//! variables, and the density in u is that in x over |det Qᵀ ∂r/∂x|.

use nalgebra::{SMatrix, SVector};

use super::coordinates::{Coordinates, DIMENSION};
use super::density::LogDensity;
use super::posterior::{Evaluation, RESIDUALS, SoilPosterior, Whitenings};

/// A distance in u that is of no account.
const CLOSE: f64 = 3e-3;
/// Newton steps before a point is given up.
const STEPS: usize = 40;
/// Longest step that is tried.
const LONGEST: f64 = 3.0;
/// Shortest share of a Newton step that is tried.
const SHORTEST: f64 = 1e-3;

/// A posterior in the straightened coordinates.
#[derive(Debug, Clone)]
pub struct Straightened<'a> {
    posterior: &'a SoilPosterior,
    whitenings: Whitenings,
    basis: SMatrix<f64, RESIDUALS, DIMENSION>,
}

/// A point in both coordinates.
#[derive(Debug, Clone)]
pub struct Place {
    /// The posterior there.
    pub evaluation: Evaluation,
    straight: Coordinates,
    slopes: SMatrix<f64, DIMENSION, DIMENSION>,
}

impl<'a> Straightened<'a> {
    /// About a mode.
    pub fn new(posterior: &'a SoilPosterior, mode: &Evaluation) -> Self {
        let whitenings = mode.whitenings();
        let basis = mode.residuals(&whitenings).1.qr().q();
        Self { posterior, whitenings, basis }
    }

    /// A point in both coordinates.
    pub fn place(&self, evaluation: Evaluation) -> Place {
        let (residuals, jacobian) = evaluation.residuals(&self.whitenings);
        Place { evaluation, straight: self.basis.transpose() * residuals, slopes: self.basis.transpose() * jacobian }
    }

    /// The point with the given straight coordinates, by damped Newton steps from `near`; none where they find none.
    pub fn find(&self, straight: &Coordinates, near: &Place) -> Option<Place> {
        let mut here = near.clone();
        for _ in 0..STEPS {
            let missing = straight - here.straight;
            if missing.norm() < CLOSE {
                return Some(here);
            }
            here = self.towards(straight, &here)?;
        }
        None
    }

    /// The longest share of a Newton step, halved again and again, that comes nearer. Distances are those of the steps that
    /// are left to go, as the present slopes see them (P. Deuflhard's natural monotonicity test): a straight step off a bent
    /// ridge is no loss there, however steep the ridge.
    fn towards(&self, straight: &Coordinates, here: &Place) -> Option<Place> {
        let slopes = here.slopes.lu();
        let step = slopes.solve(&(straight - here.straight))?;
        let mut share = (LONGEST / step.norm()).min(1.0);
        while share > SHORTEST {
            let point = here.evaluation.point + step * share;
            let found = self.posterior.evaluate(&point, &here.evaluation.sinkages_near(&point));
            if let Some(found) = found.map(|evaluation| self.place(evaluation))
                && slopes.solve(&(straight - found.straight))?.norm() < (1.0 - 0.25 * share) * step.norm()
            {
                return Some(found);
            }
            share *= 0.5;
        }
        None
    }
}

impl LogDensity<DIMENSION> for Straightened<'_> {
    type Latent = Place;

    fn ln_density(&self, straight: &SVector<f64, DIMENSION>, near: &Place) -> Option<(f64, Place)> {
        let place = self.find(straight, near)?;
        let ln_density = place.evaluation.ln_density - libm::log(place.slopes.determinant().abs());
        ln_density.is_finite().then_some((ln_density, place))
    }

    fn kept(_straight: &Coordinates, place: &Place) -> Coordinates {
        place.evaluation.point
    }
}
