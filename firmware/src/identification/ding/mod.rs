//! Decoupled identification of a driven wheel's soil: Ding, Yoshida, Nagatani, Gao and Deng, "Parameter identification for
//! planetary soil based on a decoupled analytical wheel–soil interaction terramechanics model", IROS 2009. A
//! reconstruction: the paper was not at hand, and steps 1 to 3 are what is known of it through others.
//!
//! With triangular stresses ([`super::TriangularStress`]) the unknowns fall into three groups, told one after the other:
//! 1. c₁, c₂, c₃, from the drawbar pull that load and torque leave room for;
//! 2. stiffness and exponent, from the normal stress at the peak;
//! 3. c, φ and K, from the shear stress there.
//!
//! No grousers: the shear radius is that of the wheel.

mod pressure_sinkage;
mod rows;
mod shape;
mod spread;
mod strength;
mod variance;

use crate::scalar::Scalar;
use crate::terramechanics::Wheel;

use super::least_squares::Bounds;
use super::observation::{Weighed, check};
use super::{Identified, Observation, Refusal, StressShape, Told};

pub use pressure_sinkage::PressureSinkage;
use rows::{Rows, Sensitive};
pub use spread::StressSpread;
use strength::Strength;

/// Observations that the method needs: each of its first and third step has three unknowns.
const NEEDED: usize = 3;

/// Where the method looks for its unknowns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DingBounds<S> {
    /// c₁.
    pub c1: Bounds<S>,
    /// c₂.
    pub c2: Bounds<S>,
    /// c₃.
    pub c3: Bounds<S>,
    /// Cohesion, Pa.
    pub cohesion_pa: Bounds<S>,
    /// tan φ.
    pub tan_friction: Bounds<S>,
    /// K, m; both ends above zero.
    pub shear_modulus_m: Bounds<S>,
}

impl<S: Scalar> DingBounds<S> {
    /// 0.02 ≤ c₁ ≤ 0.7, −0.3 ≤ c₂ ≤ 0.6, −0.6 ≤ c₃ ≤ 0, c ≥ 0, 0 ≤ tan φ ≤ 1.2; K of 1 to 60 mm (ours).
    pub fn usual() -> Self {
        Self {
            c1: Bounds::new(0.02, 0.7),
            c2: Bounds::new(-0.3, 0.6),
            c3: Bounds::new(-0.6, 0.0),
            cohesion_pa: Bounds::new(0.0, f64::INFINITY),
            tan_friction: Bounds::new(0.0, 1.2),
            shear_modulus_m: Bounds::new(1e-3, 60e-3),
        }
    }

    /// The same where the wheel is known to touch nothing behind its lowest point: c₃ = 0.
    pub fn without_rear_contact() -> Self {
        Self { c3: Bounds::new(0.0, 0.0), ..Self::usual() }
    }

    /// The same with c and φ of any value.
    pub fn with_any_strength(self) -> Self {
        Self { cohesion_pa: Bounds::none(), tan_friction: Bounds::none(), ..self }
    }
}

/// What the method says of a soil.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DingFit<S> {
    /// Cohesion, friction angle and shear modulus.
    pub identified: Identified<S>,
    /// c₁, c₂ and c₃.
    pub shape: StressShape<S>,
    /// Stiffness and exponent, where the sinkages differ by more than their noise.
    pub pressure_sinkage: Option<PressureSinkage<S>>,
    /// How far the normal stresses differ: what tells c from φ.
    pub spread: StressSpread<S>,
}

/// Identifies c, φ and K: see [`fit`].
///
/// # Errors
/// As [`fit`], and [`Refusal::NotIdentifiable`] where the normal stresses differ by no more than their noise would make
/// them differ under equal wheels ([`StressSpread::is_told`]): the least singular value of step 3 is then below its noise.
///
/// That is no test at a level of significance. On an instant that is too noisy to tell c from φ the standard deviations
/// say so; refused is what shows no spread at all.
pub fn ding<S: Scalar>(
    wheel: &Wheel<S>,
    observations: &[Observation<S>],
    bounds: &DingBounds<S>,
) -> Result<Identified<S>, Refusal> {
    let fit = fit(wheel, observations, bounds)?;
    if fit.spread.is_told() { Ok(fit.identified) } else { Err(Refusal::NotIdentifiable) }
}

/// Identifies the parameters of all three steps from several wheels at one instant, or from one wheel at several.
///
/// The equations are of a driven wheel: observations of negative slip are left out.
///
/// 1. c₁, c₂ and c₃ by bounded non-linear least squares (Levenberg and Marquardt, from 0.3, 0.2, −0.05);
/// 2. ln K_s, n₀ and n₁ by linear regression of ln σm;
/// 3. for each K of a grid, c and tan φ by bounded linear least squares of τm; the best K refined by golden sections.
///
/// The condition number is that of step 3's two columns brought to the same length. The standard deviations are those of
/// the observations' noise through steps 1 and 3, to first order, with c and φ as if they had no bounds; what ends at a
/// bound is not identifiable. They know nothing of the error of taking stresses for triangles, which makes K 15 … 20 %
/// too great on the seed's sand. Where K ends at a bound there are none.
///
/// Cost: some 75 sweeps over the observations, and at most 60 with three derivatives, some 20 usually.
///
/// # Errors
/// [`Refusal::TooFew`] below three driven observations, [`Refusal::NoSinkage`] where one of them has none,
/// [`Refusal::OutOfRange`] where one is outside 0 … r or a number overflows, and [`Refusal::NegativeStress`] where a normal
/// stress at the peak comes out at zero or below.
pub fn fit<S: Scalar>(
    wheel: &Wheel<S>,
    observations: &[Observation<S>],
    bounds: &DingBounds<S>,
) -> Result<DingFit<S>, Refusal> {
    check(wheel, observations, NEEDED, Weighed::All)?;
    let rows = Rows::new(wheel, observations)?;
    if rows.count() < NEEDED {
        return Err(Refusal::TooFew { needed: NEEDED as u8 });
    }
    let shape = shape::fit(&rows, bounds).ok_or(Refusal::OutOfRange)?;
    if !rows.stresses(&shape).all(|stress| stress.normal_pa > S::zero()) {
        return Err(Refusal::NegativeStress);
    }
    let strength = strength::fit(&rows, &shape, bounds);
    let sensitive = Sensitive::new(&rows, &shape);
    let line = strength::line(&rows, &shape, strength.shear_modulus_m);
    let inside = bounds.shear_modulus_m.contains_inside(strength.shear_modulus_m);
    let variances = if inside { variance::of(&sensitive, &strength, bounds) } else { None };
    Ok(DingFit {
        identified: told(&strength, variances, line.condition_number(), bounds).in_numbers()?,
        shape,
        pressure_sinkage: pressure_sinkage::fit(&sensitive),
        spread: StressSpread::new(&sensitive, &line, strength.shear_modulus_m),
    })
}

/// The answer, from the variances of c, tan φ and ln K.
fn told<S: Scalar>(
    strength: &Strength<S>,
    variances: Option<[S; 3]>,
    condition_number: S,
    bounds: &DingBounds<S>,
) -> Identified<S> {
    let [std_c, std_tan, std_ln_k] = match variances {
        Some(variances) => variances.map(|variance| Some(variance.sqrt())),
        None => [None; 3],
    };
    let (c, tan) = (strength.cohesion_pa, strength.tan_friction);
    Identified {
        cohesion_pa: Told::cohesion(c, std_c).only_if(bounds.cohesion_pa.contains_inside(c)),
        friction_angle_rad: Told::friction(tan, std_tan).only_if(bounds.tan_friction.contains_inside(tan)),
        shear_modulus_m: Told::shear_modulus(strength.shear_modulus_m, std_ln_k),
        condition_number,
    }
}
