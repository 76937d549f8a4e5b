//! The shear stress under the rim, equation 1: what the soil holds, and how much of that is mobilised.

use crate::scalar::Scalar;

use super::Soil;
use super::shear_displacement::ShearDisplacement;

/// What soil and rim hold under a normal stress: Coulomb's strength c + σ tan φ, and the most that the rim can hold.
#[derive(Debug, Clone, Copy)]
pub(super) struct Strength<S> {
    cohesion_pa: S,
    tan_friction: S,
    cap: Option<Cap<S>>,
}

/// The most that the rim can hold: c_a + σ tan δ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cap<S> {
    /// c_a, Pa.
    pub adhesion_pa: S,
    /// tan δ.
    pub tan: S,
}

/// What is held at a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Held<S> {
    /// By the soil, Pa.
    pub strength_pa: S,
    /// By the rim at most, Pa.
    pub cap_pa: Option<S>,
}

impl<S: Scalar> Strength<S> {
    /// That of a soil, and of a rim where it is less.
    pub fn new(soil: &Soil<S>, cap: Option<Cap<S>>) -> Self {
        let (sin, cos) = soil.friction_angle_rad.sin_cos();
        Self { cohesion_pa: soil.cohesion_pa, tan_friction: sin / cos, cap }
    }

    /// Whether the rim may hold less than the soil.
    pub fn is_capped(&self) -> bool {
        self.cap.is_some()
    }

    /// The same in another scalar, number by number.
    pub fn map<T>(&self, mut convert: impl FnMut(S) -> T) -> Strength<T> {
        Strength {
            cohesion_pa: convert(self.cohesion_pa),
            tan_friction: convert(self.tan_friction),
            cap: self.cap.map(|cap| Cap { adhesion_pa: convert(cap.adhesion_pa), tan: convert(cap.tan) }),
        }
    }

    /// Under the normal stress σ, Pa.
    #[inline(always)]
    pub fn at(&self, normal_pa: S) -> Held<S> {
        Held {
            strength_pa: self.cohesion_pa + normal_pa * self.tan_friction,
            cap_pa: self.cap.map(|cap| cap.adhesion_pa + normal_pa * cap.tan),
        }
    }
}

/// The share of the strength that shear displacement mobilises (Janosi and Hanamoto): 1 − e^(−|j|/K).
#[derive(Debug, Clone, Copy)]
pub(super) struct Mobilisation<S> {
    /// K a / r: what q = a j / r is measured against.
    pub scale: S,
}

impl<S: Scalar> Mobilisation<S> {
    /// In `soil` under a wheel that shears it at the given radius (m).
    pub fn new(soil: &Soil<S>, radius_m: S, displacement: &ShearDisplacement<S>) -> Self {
        // The floor makes K → 0 and the locked wheel what they are in the limit: everything mobilised.
        Self { scale: (soil.shear_modulus_m * displacement.rim_share / radius_m).max(S::constant(1e-30)) }
    }

    /// The same in another scalar, number by number.
    pub fn map<T>(&self, mut convert: impl FnMut(S) -> T) -> Mobilisation<T> {
        Mobilisation { scale: convert(self.scale) }
    }

    /// The share at a displacement |q|.
    #[inline(always)]
    pub fn at(&self, displacement: S) -> S {
        S::one() - (-(displacement / self.scale)).exp()
    }
}
