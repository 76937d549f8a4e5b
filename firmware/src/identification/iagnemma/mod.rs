//! Cohesion and friction from load, torque, slip and sinkage by linear least squares: Iagnemma, Shibly and Dubowsky, ICRA
//! 2002; Iagnemma, Kang, Shibly and Dubowsky, IEEE T-RO 20:921, 2004. A reconstruction: the papers were not at hand.
//!
//! The stresses are triangles that peak half way to the entry and end at the lowest point. Load and torque then give the
//! normal stress κ₁ and the shear stress at the peak; the latter, over the share of the strength that is mobilised there,
//! is κ₂, and Coulomb's law is a line: c + κ₁ tan φ = κ₂. K is assumed. The drawbar pull is not used.

mod recursive;

use crate::scalar::Scalar;
use crate::terramechanics::Wheel;

use super::observation::{Weighed, check};
use super::{Assumed, Identified, Observation, Refusal};

pub use recursive::Recursive;

/// What the method takes as given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IagnemmaAssumptions<S> {
    /// K, m, above zero.
    pub shear_modulus_m: Assumed<S>,
    /// c, Pa, where it is held to be known: zero on dry sand. Else it is estimated.
    pub cohesion_pa: Option<Assumed<S>>,
}

impl<S: Scalar> IagnemmaAssumptions<S> {
    /// Observations that the method needs: as many as it has unknowns.
    fn needed(&self) -> u8 {
        if self.cohesion_pa.is_some() { 1 } else { 2 }
    }
}

/// Identifies c and φ from several wheels at one instant, or from one wheel at several. Every observation counts the same.
///
/// The equations are of a driven wheel: observations of negative slip are left out.
///
/// The condition number is that of the columns 1 and κ₁ brought to the same length; it is the spread of κ₁, and so of the
/// load, that sets it. The standard deviations are s² (XᵀX)⁻¹ with s² of the residuals; there are none where there are no
/// more observations than unknowns. They take κ₁ as exact. c may come out negative: it is then not identifiable.
///
/// # Errors
/// [`Refusal::TooFew`] below two driven observations (one where c is assumed), [`Refusal::NoSinkage`] where one of them
/// has none, [`Refusal::OutOfRange`] where one is outside 0 … r, the assumed K is not above zero or a number overflows,
/// [`Refusal::NegativeStress`] where a normal stress comes out at zero or below, [`Refusal::NotIdentifiable`] where all
/// normal stresses are equal to the last digits.
pub fn iagnemma<S: Scalar>(
    wheel: &Wheel<S>,
    observations: &[Observation<S>],
    assumed: &IagnemmaAssumptions<S>,
) -> Result<Identified<S>, Refusal> {
    check(wheel, observations, usize::from(assumed.needed()), Weighed::Nothing)?;
    let mut line = Recursive::new(assumed, S::one())?;
    for observation in observations {
        line.add(wheel, observation)?;
    }
    line.identified()
}
