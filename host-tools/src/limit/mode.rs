//! The mode of the posterior.

use nalgebra::SMatrix;

use super::coordinates::{Coordinates, DIMENSION};
use super::posterior::{Evaluation, SoilPosterior};

/// Most steps towards the mode.
const STEPS: usize = 60;
/// Half of the sum of squares changes by less at the mode.
const SETTLED: f64 = 1e-3;
/// Damping at which no step lowers the sum of squares any more.
const STUCK: f64 = 1e8;

/// Where the sum of squared residuals is least, by Levenberg–Marquardt from the middle of the prior; none where that cannot
/// be evaluated.
pub fn mode(posterior: &SoilPosterior) -> Option<Evaluation> {
    let mut here = posterior.evaluate(&Coordinates::zeros(), &posterior.guess())?;
    let mut damping = 1e-2;
    for _ in 0..STEPS {
        let Some((next, gain)) = descend(posterior, &here, &mut damping) else { break };
        here = next;
        if gain < SETTLED {
            break;
        }
    }
    Some(here)
}

/// A step that lowers the sum of squares, and by how much; none where no damping finds one.
fn descend(posterior: &SoilPosterior, here: &Evaluation, damping: &mut f64) -> Option<(Evaluation, f64)> {
    let whitenings = here.whitenings();
    let (residuals, jacobian) = here.residuals(&whitenings);
    // The prior adds the unit matrix: this is positive definite.
    let hessian: SMatrix<f64, DIMENSION, DIMENSION> = jacobian.transpose() * jacobian;
    let gradient = jacobian.transpose() * residuals;
    while *damping < STUCK {
        let mut damped = hessian;
        damped.set_diagonal(&(hessian.diagonal() * (1.0 + *damping)));
        let next = here.point - damped.cholesky()?.solve(&gradient);
        let found = posterior.evaluate(&next, &here.sinkages_near(&next));
        let gain = |found: &Evaluation| residuals.norm_squared() - found.residuals(&whitenings).0.norm_squared();
        if let Some(found) = found.map(|found| (gain(&found), found)).filter(|(gain, _)| *gain > 0.0) {
            *damping *= 0.2;
            return Some((found.1, 0.5 * found.0));
        }
        *damping *= 5.0;
    }
    None
}
