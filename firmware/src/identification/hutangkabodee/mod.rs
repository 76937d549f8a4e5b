//! Friction angle, shear modulus and stiffness from drawbar pull, slip and sinkage: Hutangkabodee, Zweiri, Seneviratne and
//! Althoefer, ICRA 2006 and International Journal of Automation and Computing 3:244–251. A reconstruction: the papers were
//! not at hand.
//!
//! The drawbar pull of equations 3 and 6–11, integrated by composite Simpson's rule, is set equal to the one measured in
//! samples of one soil at different slips; Newton–Raphson solves for φ, K and k = k_c/b + k_φ. Cohesion, which the papers
//! hold to have little influence on the drawbar pull, is assumed, and so are n, c₁, c₂ and η. With more samples than three
//! Newton's method becomes Gauss–Newton's.
//!
//! Ours beside that: unknowns by their logarithms, within the bounds of [`super::SoilPrior::usual`]; Levenberg's damping,
//! without which the iteration runs away from a poor start; and standard deviations. The method takes slip and sinkage as
//! exact: what their noise does is known to it from the residuals alone, and biases it.

mod drawbar_pull;
mod search;

use crate::scalar::Scalar;
use crate::terramechanics::{Soil, Wheel};

use super::least_squares::Triangle;
use super::observation::{Weighed, check};
use super::singular_values::singular_values;
use super::{Identified, Observation, Refusal, SoilPrior, Told};

use drawbar_pull::DrawbarPulls;
pub use search::Steps;
use search::{Bounds, Settled, search};

/// Samples that the method needs: as many as it has unknowns.
const NEEDED: usize = 3;

/// φ, K and k, or their logarithms.
type Unknowns<S> = [S; 3];
/// An equation for each sample, straightened.
type Equations<S> = Triangle<S, 3>;

/// What the method says of a soil.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit<S> {
    /// Cohesion (assumed), friction angle and shear modulus.
    pub identified: Identified<S>,
    /// Stiffness k = k_c/b + k_φ, Pa/mⁿ.
    pub stiffness: Told<S>,
    /// Steps that the iteration took.
    pub steps: u8,
}

/// Identifies φ and K of one soil: see [`fit`], with damped steps.
///
/// # Errors
/// As [`fit`].
pub fn hutangkabodee<S: Scalar>(
    wheel: &Wheel<S>,
    observations: &[Observation<S>],
    assumed: &Soil<S>,
) -> Result<Identified<S>, Refusal> {
    fit(wheel, observations, assumed, Steps::Damped).map(|fit| fit.identified)
}

/// Identifies φ, K and k of one soil from slip, sinkage and drawbar pull of three observations or more, which may be of one
/// wheel or of several alike. φ, K and k of `assumed` are where the iteration starts; all else of it is taken as it is.
///
/// The equations are of a driven wheel: observations of negative slip are left out.
///
/// The condition number is that of the derivatives of the drawbar pulls, over their noise, with respect to ln φ, ln K and
/// ln k. The standard deviations are s²(JᵀJ)⁻¹ with that matrix J; s² is the residuals' variance over the noise's, and at
/// least 1. What ends at a bound is not identifiable.
///
/// Cost: each step integrates 40 intervals an observation, with three derivatives; at most 60 steps, seven to ten
/// usually.
///
/// # Errors
/// [`Refusal::TooFew`] below three driven observations, [`Refusal::NoSinkage`] where one of them has none,
/// [`Refusal::OutOfRange`] where a sinkage is not within 0 … r or the assumed soil is none, [`Refusal::NotConverged`], and
/// [`Refusal::NotIdentifiable`] where the least singular value of J is below 1: some combination of the unknowns could
/// change by a factor of e within the noise.
pub fn fit<S: Scalar>(
    wheel: &Wheel<S>,
    observations: &[Observation<S>],
    assumed: &Soil<S>,
    steps: Steps,
) -> Result<Fit<S>, Refusal> {
    check(wheel, observations, NEEDED, Weighed::DrawbarPull)?;
    let pulls = DrawbarPulls::new(wheel, observations, assumed)?;
    if pulls.count() < NEEDED {
        return Err(Refusal::TooFew { needed: NEEDED as u8 });
    }
    let prior = SoilPrior::usual();
    let bounds = Bounds::of(&prior);
    let settled = search(&pulls, &bounds, steps).ok_or(Refusal::NotConverged)?;
    // Rows and columns of a matrix have the same singular values.
    let [a, b, c] = singular_values(settled.equations.root);
    let (greatest, least) = (a.max(b).max(c), a.min(b).min(c));
    match deviations(&settled.equations, pulls.count()) {
        Some(stds) if least >= S::one() => {
            Ok(answer(&settled, stds, &bounds, &prior, assumed).conditioned(greatest / least))
        }
        _ => Err(Refusal::NotIdentifiable),
    }
}

/// The standard deviations of ln φ, ln K and ln k, by the residuals of so many samples where these exceed the noise.
fn deviations<S: Scalar>(equations: &Equations<S>, samples: usize) -> Option<Unknowns<S>> {
    let spare = S::constant(samples.saturating_sub(NEEDED).max(1) as f64);
    let scale = (equations.rest / spare).max(S::one());
    equations.variances().map(|variances| variances.map(|variance| (scale * variance).sqrt()))
}

fn answer<S: Scalar>(
    settled: &Settled<S>,
    stds: Unknowns<S>,
    bounds: &Bounds<S>,
    prior: &SoilPrior<S>,
    assumed: &Soil<S>,
) -> Fit<S> {
    let [friction_angle_rad, shear_modulus_m, stiffness] = settled.at.map(Scalar::exp);
    let [angle_std, modulus_std, stiffness_std] = stds;
    let [angle_free, modulus_free, stiffness_free] = bounds.inside(&settled.at);
    let told = |value: S, std: S, ratio: S, free: bool| {
        let told = Told::estimated(value, Some(std), ratio);
        Told { identifiable: told.identifiable && free, ..told }
    };
    let over = |std: S, believed: Option<S>| std / believed.unwrap_or(S::one());
    let angle_std = friction_angle_rad * angle_std;
    Fit {
        identified: Identified {
            cohesion_pa: Told::assumed(
                assumed.cohesion_pa,
                assumed.cohesion_pa * prior.ln_cohesion.std.unwrap_or(S::one()),
            ),
            friction_angle_rad: told(
                friction_angle_rad,
                angle_std,
                over(angle_std, prior.friction_angle_rad.std),
                angle_free,
            ),
            shear_modulus_m: told(
                shear_modulus_m,
                shear_modulus_m * modulus_std,
                over(modulus_std, prior.ln_shear_modulus.std),
                modulus_free,
            ),
            condition_number: S::one(),
        },
        stiffness: told(
            stiffness,
            stiffness * stiffness_std,
            over(stiffness_std, prior.ln_stiffness.std),
            stiffness_free,
        ),
        steps: settled.steps,
    }
}

impl<S: Scalar> Fit<S> {
    fn conditioned(self, condition_number: S) -> Self {
        Self { identified: Identified { condition_number, ..self.identified }, ..self }
    }
}
