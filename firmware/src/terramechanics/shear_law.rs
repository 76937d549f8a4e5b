//! How the soil shears on the rim: the seed's law, and the same with what effects change.

use crate::scalar::Scalar;

use super::Contact;
use super::rim::{Rim, RimPoint};
use super::shear_displacement::ShearDisplacement;
use super::shear_stress::ShearStress;

/// Shear stress on the rim, Pa.
#[derive(Debug, Clone, Copy)]
pub(super) struct Traction<S> {
    /// Along the rim.
    pub along_pa: S,
    /// Along the axle.
    pub across_pa: S,
}

/// A law of shear on the rim.
pub(super) trait ShearLaw<S> {
    /// Radius at which the soil shears, over the wheel's.
    fn radius_ratio(&self) -> S;
    /// The stress at a point of the rim under the normal stress `normal_pa`.
    fn at(&self, normal_pa: S, point: &RimPoint<S>) -> Traction<S>;
}

/// Equations 1 and 2.
pub(super) struct PlainShear<'a, S> {
    /// Equation 2.
    pub displacement: &'a ShearDisplacement<S>,
    /// Equation 1.
    pub stress: &'a ShearStress<S>,
}

impl<S: Scalar> ShearLaw<S> for PlainShear<'_, S> {
    fn radius_ratio(&self) -> S {
        S::one()
    }

    #[inline(always)]
    fn at(&self, normal_pa: S, point: &RimPoint<S>) -> Traction<S> {
        Traction { along_pa: self.stress.at(normal_pa, self.displacement.at(point)), across_pa: S::zero() }
    }
}

/// What effects change in equations 1 and 2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShearConditions<S> {
    /// Radius at which the soil shears, over the wheel's, where it is another.
    pub radius_ratio: Option<S>,
    /// Tangent of the slip angle, where the wheel slides sideways.
    pub tan_slip_angle: Option<S>,
    /// The most that the rim can hold.
    pub cap: Option<Cap<S>>,
    /// A peak in the mobilised share.
    pub hump: Option<Hump<S>>,
}

/// The most that the rim can hold: c_a + σ tan δ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cap<S> {
    /// c_a, Pa.
    pub adhesion_pa: S,
    /// tan δ.
    pub tan: S,
}

/// A peak in the mobilised share of the strength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hump<S> {
    /// Part of the soil that has it.
    pub share: S,
    /// Residual over peak.
    pub residual: S,
}

impl<S: Scalar> ShearConditions<S> {
    /// Those of the seed's equations.
    pub fn plain() -> Self {
        Self { radius_ratio: None, tan_slip_angle: None, cap: None, hump: None }
    }

    /// No effect touches them.
    pub fn is_plain(&self) -> bool {
        self.radius_ratio.is_none() && self.tan_slip_angle.is_none() && self.cap.is_none() && self.hump.is_none()
    }
}

/// Equations 1 and 2 with what effects change.
pub(super) struct AlteredShear<'a, S> {
    displacement: &'a ShearDisplacement<S>,
    stress: &'a ShearStress<S>,
    conditions: ShearConditions<S>,
    /// a j / r at the rim's entry, where the greater shear radius has met the soil already.
    ahead: S,
}

impl<'a, S: Scalar> AlteredShear<'a, S> {
    /// The law at a contact.
    pub fn new(
        displacement: &'a ShearDisplacement<S>,
        stress: &'a ShearStress<S>,
        conditions: ShearConditions<S>,
        contact: &Contact<S>,
    ) -> Self {
        let ahead = conditions.radius_ratio.map(|ratio| ahead(displacement, ratio, contact.entry_rad));
        Self { displacement, stress, conditions, ahead: ahead.unwrap_or(S::zero()) }
    }
}

/// The shear that a greater radius has gathered where the rim enters: its own entry is θ₁' = arccos(cos θ₁ · r/r_s).
fn ahead<S: Scalar>(displacement: &ShearDisplacement<S>, radius_ratio: S, entry_rad: S) -> S {
    let entry = (entry_rad.cos() / radius_ratio).acos();
    displacement.at(&Rim::new(entry).point(entry - entry_rad))
}

impl<S: Scalar> ShearLaw<S> for AlteredShear<'_, S> {
    fn radius_ratio(&self) -> S {
        self.conditions.radius_ratio.unwrap_or(S::one())
    }

    #[inline(always)]
    fn at(&self, normal_pa: S, point: &RimPoint<S>) -> Traction<S> {
        let along = self.displacement.at(point) + self.ahead;
        let Some(tan_slip_angle) = self.conditions.tan_slip_angle else {
            let held_pa = self.held_pa(normal_pa, along.abs());
            return Traction { along_pa: if along < S::zero() { -held_pa } else { held_pa }, across_pa: S::zero() };
        };
        let across = self.displacement.across(point) * tan_slip_angle;
        let size = (along * along + across * across).sqrt();
        let per_displacement = self.held_pa(normal_pa, size) / size.max(S::constant(1e-30));
        Traction { along_pa: per_displacement * along, across_pa: per_displacement * across }
    }
}

impl<S: Scalar> AlteredShear<'_, S> {
    /// The size of the stress at a displacement |q|, Pa.
    #[inline(always)]
    fn held_pa(&self, normal_pa: S, displacement: S) -> S {
        let mobilised = self.stress.mobilised(displacement);
        let mobilised = self.conditions.hump.map_or(mobilised, |hump| hump.mobilised(mobilised));
        let held_pa = self.stress.strength_pa(normal_pa) * mobilised;
        self.conditions.cap.map_or(held_pa, |cap| held_pa.min(cap.adhesion_pa + normal_pa * cap.tan))
    }
}

impl<S: Scalar> Hump<S> {
    /// The share that is mobilised where it would be 1 − e^(−j/K) without a peak: Wong's law, as a function of that.
    #[inline(always)]
    fn mobilised(&self, plain: S) -> S {
        const E: f64 = core::f64::consts::E;
        let remaining = S::one() - plain;
        let excess = S::one() / (self.residual * S::constant(1.0 - 1.0 / E)) - S::one();
        let peaked = self.residual * (S::one() + S::constant(E) * excess * remaining) * plain;
        plain + self.share * (peaked - plain)
    }
}
