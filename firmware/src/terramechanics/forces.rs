//! Drawbar pull, load and torque at a given slip and sinkage: equations 3–5.

use crate::scalar::Scalar;

use super::integrals::{Place, integrate};
use super::normal_stress::NormalStress;
use super::quadrature::Quadrature;
use super::shear_displacement::ShearDisplacement;
use super::shear_law::PlainShear;
use super::shear_stress::{Mobilisation, Strength};
use super::{Contact, Soil, Wheel};

/// What the soil does to a wheel, equations 3–5.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WheelForces<S> {
    /// Drawbar pull DP, N, positive forward.
    pub drawbar_pull_n: S,
    /// Normal load W, N, positive downward on the soil.
    pub load_n: S,
    /// Resistive torque T, N·m, positive when the soil resists forward rotation.
    pub torque_nm: S,
}

/// Why no forces could be computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ForceError {
    /// Slip outside −1 … 1, or not a number.
    Slip,
    /// Sinkage outside 0 … r, or not a number.
    Sinkage,
    /// The wheel has no radius or no width: see [`Wheel::is_valid`].
    Wheel,
    /// A parameter of the soil is outside its range: see [`Soil::is_valid`].
    Soil,
    /// A force is too great for the scalar.
    Overflow,
}

/// Drawbar pull, load and torque of a wheel at the given slip (−1 … 1) and sinkage (m, 0 … r): equations 1–11 of the seed.
///
/// At a slip of −1 (a locked wheel) shear is fully mobilised, backward, everywhere; so it is, in its own sense, for K = 0.
///
/// Error: below 1e-7 of W (of rW for the torque) in double precision, 2e-4 in single, for slips of ±0.95, sinkages of
/// 0.01 … 0.6 r and exponents of 0.11 … 1.7. Where W is less than a hundredth of the stresses it is the balance of, the
/// error is that share of a hundredth of them.
///
/// Cost: one panel of nodes (8 in single precision, 16 in double) while j stays below 8 K (15 K in double precision), two
/// for thinner shear, at most ten when braking; a node takes two sines with cosines, three exponentials and a logarithm.
///
/// # Errors
/// Where an input is outside its range, or a force overflows.
pub fn wheel_forces<S: Scalar>(
    wheel: &Wheel<S>,
    soil: &Soil<S>,
    slip: S,
    sinkage_m: S,
) -> Result<WheelForces<S>, ForceError> {
    wheel_forces_by(&Quadrature::for_scalar::<S>(), wheel, soil, slip, sinkage_m)
}

/// [`wheel_forces`] by a stated quadrature.
///
/// # Errors
/// As [`wheel_forces`].
pub fn wheel_forces_by<S: Scalar>(
    quadrature: &Quadrature,
    wheel: &Wheel<S>,
    soil: &Soil<S>,
    slip: S,
    sinkage_m: S,
) -> Result<WheelForces<S>, ForceError> {
    check(wheel, soil, slip, sinkage_m)?;
    let contact = Contact::new(wheel, soil, slip, sinkage_m);
    let displacement = ShearDisplacement::new(slip);
    let mobilisation = Mobilisation::new(soil, wheel.radius_m, &displacement);
    let place = Place {
        contact: &contact,
        normal: &NormalStress::new(wheel, soil),
        displacement: &displacement,
        strength: &Strength::new(soil, None),
        layer: mobilisation.scale,
    };
    let found = integrate(quadrature, &place, &PlainShear { mobilisation });
    let area = wheel.radius_m * wheel.width_m;
    let forces = WheelForces {
        drawbar_pull_n: area * found.pull,
        load_n: area * found.load,
        torque_nm: area * wheel.radius_m * found.torque,
    };
    if forces.is_finite() { Ok(forces) } else { Err(ForceError::Overflow) }
}

impl<S: Scalar> WheelForces<S> {
    fn is_finite(&self) -> bool {
        self.drawbar_pull_n.is_finite() && self.load_n.is_finite() && self.torque_nm.is_finite()
    }
}

/// Whether the equations hold for these inputs.
pub(super) fn check<S: Scalar>(wheel: &Wheel<S>, soil: &Soil<S>, slip: S, sinkage_m: S) -> Result<(), ForceError> {
    if !wheel.is_valid() {
        return Err(ForceError::Wheel);
    }
    if !soil.is_valid() {
        return Err(ForceError::Soil);
    }
    if !(slip >= -S::one() && slip <= S::one()) {
        return Err(ForceError::Slip);
    }
    if !(sinkage_m >= S::zero() && sinkage_m <= wheel.radius_m) {
        return Err(ForceError::Sinkage);
    }
    Ok(())
}
