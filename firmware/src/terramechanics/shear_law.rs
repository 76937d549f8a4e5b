//! How the soil shears on the rim: the seed's law, and the same with what effects change.

use crate::scalar::Scalar;

use super::Contact;
use super::rim::{Rim, RimPoint};
use super::shear_displacement::ShearDisplacement;
use super::shear_stress::{Cap, Held, Mobilisation};

/// How far the rim has slid over the soil at a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slide<S> {
    /// Along the rim: [`ShearDisplacement::at`].
    pub along: S,
    /// Along the axle, per tangent of the slip angle: [`ShearDisplacement::across`].
    pub across: S,
}

impl<S: Scalar> Slide<S> {
    /// At a point.
    #[inline(always)]
    pub fn at(displacement: &ShearDisplacement<S>, point: &RimPoint<S>) -> Self {
        Self { along: displacement.at(point), across: displacement.across(point) }
    }
}

/// Shear stress on the rim, Pa.
#[derive(Debug, Clone, Copy)]
pub(super) struct Traction<S> {
    /// Along the rim, per area of the wheel's own rim.
    pub along_pa: S,
    /// The same times its lever over the wheel's radius.
    pub turning_pa: S,
    /// Along the axle.
    pub across_pa: S,
}

impl<S: Scalar> Traction<S> {
    /// None.
    pub fn zero() -> Self {
        Self { along_pa: S::zero(), turning_pa: S::zero(), across_pa: S::zero() }
    }

    /// The same in another scalar.
    #[inline(always)]
    pub fn map<T>(&self, convert: impl Fn(S) -> T) -> Traction<T> {
        Traction {
            along_pa: convert(self.along_pa),
            turning_pa: convert(self.turning_pa),
            across_pa: convert(self.across_pa),
        }
    }
}

/// A law of shear on the rim.
pub(super) trait ShearLaw<S> {
    /// The same law in another scalar.
    type In<T: Scalar>: ShearLaw<T>;
    /// Whether it asks how far the rim has slid along the axle.
    const IS_SIDEWAYS: bool;

    /// The same in another scalar, number by number, always in the same order.
    fn map<T: Scalar>(&self, convert: impl FnMut(S) -> T) -> Self::In<T>;
    /// The stress that a soil which holds as much exerts where the rim has slid.
    fn at(&self, held: &Held<S>, slide: &Slide<S>) -> Traction<S>;
}

/// Equation 1.
pub(super) struct PlainShear<S> {
    /// How much of the strength is mobilised.
    pub mobilisation: Mobilisation<S>,
}

impl<S: Scalar> ShearLaw<S> for PlainShear<S> {
    type In<T: Scalar> = PlainShear<T>;
    const IS_SIDEWAYS: bool = false;

    fn map<T: Scalar>(&self, convert: impl FnMut(S) -> T) -> PlainShear<T> {
        PlainShear { mobilisation: self.mobilisation.map(convert) }
    }

    #[inline(always)]
    fn at(&self, held: &Held<S>, slide: &Slide<S>) -> Traction<S> {
        let size_pa = held.strength_pa * self.mobilisation.at(slide.along.abs());
        let along_pa = if slide.along < S::zero() { -size_pa } else { size_pa };
        Traction { along_pa, turning_pa: along_pa, across_pa: S::zero() }
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

/// Equation 1 with what effects change.
pub(super) struct AlteredShear<S> {
    mobilisation: Mobilisation<S>,
    radius_ratio: Option<S>,
    tan_slip_angle: Option<S>,
    hump: Option<Hump<S>>,
    /// a j / r at the rim's entry, where a greater shear radius has met the soil already.
    ahead: Option<S>,
}

impl<S: Scalar> AlteredShear<S> {
    /// The law at a contact.
    pub fn new(
        displacement: &ShearDisplacement<S>,
        mobilisation: Mobilisation<S>,
        conditions: &ShearConditions<S>,
        contact: &Contact<S>,
    ) -> Self {
        let ShearConditions { radius_ratio, tan_slip_angle, hump, .. } = *conditions;
        let ahead = radius_ratio.map(|ratio| ahead(displacement, ratio, contact.entry_rad));
        Self { mobilisation, radius_ratio, tan_slip_angle, hump, ahead }
    }
}

/// The shear that a greater radius has gathered where the rim enters: its own entry is θ₁' = arccos(cos θ₁ · r/r_s).
fn ahead<S: Scalar>(displacement: &ShearDisplacement<S>, radius_ratio: S, entry_rad: S) -> S {
    let entry = (entry_rad.cos() / radius_ratio).acos();
    displacement.at(&Rim::new(entry).point(entry - entry_rad))
}

impl<S: Scalar> ShearLaw<S> for AlteredShear<S> {
    type In<T: Scalar> = AlteredShear<T>;
    const IS_SIDEWAYS: bool = true;

    fn map<T: Scalar>(&self, mut convert: impl FnMut(S) -> T) -> AlteredShear<T> {
        AlteredShear {
            mobilisation: self.mobilisation.map(&mut convert),
            radius_ratio: self.radius_ratio.map(&mut convert),
            tan_slip_angle: self.tan_slip_angle.map(&mut convert),
            hump: self.hump.map(|hump| Hump { share: convert(hump.share), residual: convert(hump.residual) }),
            ahead: self.ahead.map(&mut convert),
        }
    }

    #[inline(always)]
    fn at(&self, held: &Held<S>, slide: &Slide<S>) -> Traction<S> {
        let along = self.ahead.map_or(slide.along, |ahead| slide.along + ahead);
        let (along_pa, across_pa) = match self.tan_slip_angle {
            None => {
                let size_pa = self.size_pa(held, along.abs());
                (if along < S::zero() { -size_pa } else { size_pa }, S::zero())
            }
            Some(tan_slip_angle) => {
                let across = slide.across * tan_slip_angle;
                let size = (along * along + across * across).sqrt();
                let per_displacement = self.size_pa(held, size) / size.max(S::constant(1e-30));
                (per_displacement * along, per_displacement * across)
            }
        };
        match self.radius_ratio {
            None => Traction { along_pa, turning_pa: along_pa, across_pa },
            Some(ratio) => {
                let along_pa = ratio * along_pa;
                Traction { along_pa, turning_pa: ratio * along_pa, across_pa }
            }
        }
    }
}

impl<S: Scalar> AlteredShear<S> {
    /// The size of the stress at a displacement |q|, Pa.
    #[inline(always)]
    fn size_pa(&self, held: &Held<S>, displacement: S) -> S {
        let mobilised = self.mobilisation.at(displacement);
        let mobilised = self.hump.map_or(mobilised, |hump| hump.mobilised(mobilised));
        let size_pa = held.strength_pa * mobilised;
        held.cap_pa.map_or(size_pa, |cap_pa| size_pa.min(cap_pa))
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
