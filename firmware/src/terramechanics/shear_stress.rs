//! The shear stress under the rim: equation 1.

use crate::scalar::Scalar;

use super::Soil;
use super::shear_displacement::ShearDisplacement;

/// Coulomb's strength mobilised by shear displacement (Janosi and Hanamoto): τ = (c + σ tan φ)(1 − e^(−|j|/K)), with the
/// sign of j.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShearStress<S> {
    cohesion_pa: S,
    tan_friction: S,
    /// K a / r: what q = a j / r is measured against.
    pub scale: S,
}

impl<S: Scalar> ShearStress<S> {
    /// The shear of `soil` under a wheel of the given radius (m).
    pub fn new(soil: &Soil<S>, radius_m: S, displacement: &ShearDisplacement<S>) -> Self {
        let (sin, cos) = soil.friction_angle_rad.sin_cos();
        // The floor makes K → 0 and the locked wheel what they are in the limit: everything mobilised.
        let scale = (soil.shear_modulus_m * displacement.rim_share / radius_m).max(S::constant(1e-30));
        Self { cohesion_pa: soil.cohesion_pa, tan_friction: sin / cos, scale }
    }

    /// τ, Pa, under the normal stress σ (Pa) at the displacement q = a j / r.
    // The target has too few registers for a copy in every place that uses it.
    #[cfg_attr(not(target_os = "none"), inline(always))]
    pub fn at(&self, normal_pa: S, displacement: S) -> S {
        let held_pa = self.strength_pa(normal_pa) * self.mobilised(displacement.abs());
        if displacement < S::zero() { -held_pa } else { held_pa }
    }

    /// Coulomb's strength c + σ tan φ, Pa.
    #[inline(always)]
    pub fn strength_pa(&self, normal_pa: S) -> S {
        self.cohesion_pa + normal_pa * self.tan_friction
    }

    /// The share of it that is mobilised at a displacement |q|.
    #[inline(always)]
    pub fn mobilised(&self, displacement: S) -> S {
        S::one() - (-(displacement / self.scale)).exp()
    }
}
