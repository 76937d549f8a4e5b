//! The integrals of equations 3–5 over the contact.

use core::ops::{Add, AddAssign};

use crate::scalar::Scalar;

use super::Contact;
use super::integral_slopes::with_slopes;
use super::normal_stress::NormalStress;
use super::panels::{Panels, ShearLayer};
use super::quadrature::Quadrature;
use super::rim::Rim;
use super::shear_displacement::ShearDisplacement;
use super::shear_law::{ShearLaw, Slide, Traction};
use super::shear_stress::Strength;

/// The integrals of equations 3–5 without the factors rb and r²b, Pa, and that of the stress along the axle; or what one
/// point adds to them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Integrals<S> {
    pub pull: S,
    pub load: S,
    pub torque: S,
    pub side: S,
}

/// What the integrals follow from beside the law of shear.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place<'a, S> {
    pub contact: &'a Contact<S>,
    pub normal: &'a NormalStress<S>,
    pub displacement: &'a ShearDisplacement<S>,
    pub strength: &'a Strength<S>,
    /// K a / r: where shear is not yet mobilised, the contact is divided by this.
    pub layer: S,
}

/// How the rim stands at a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stand<S> {
    /// One.
    pub unit: S,
    /// cos θ.
    pub cos: S,
    /// sin θ.
    pub sin: S,
}

/// Integrates the stresses over the contact.
pub(super) fn integrate<S: Scalar>(
    quadrature: &Quadrature,
    place: &Place<'_, S>,
    law: &impl ShearLaw<S>,
) -> Integrals<S> {
    let panels = place.panels(quadrature);
    if S::IS_CHAINED { with_slopes(quadrature, &panels, place, law) } else { carried(quadrature, &panels, place, law) }
}

/// Integrates the stresses over the contact, in panels, whatever the scalar carries along carried through every operation.
pub(super) fn carried<S: Scalar>(
    quadrature: &Quadrature,
    panels: &Panels<S::Plain>,
    place: &Place<'_, S>,
    law: &impl ShearLaw<S>,
) -> Integrals<S> {
    let Place { contact, normal, displacement, strength, .. } = *place;
    let rim = Rim::new(contact.entry_rad);
    let (front, rear, span) = (contact.front_rad(), contact.rear_rad(), contact.span_rad());
    let mut sum = Integrals::zero();
    for (start, length) in panels.iter() {
        for node in quadrature.place(start, length) {
            let ahead = rim.point(front.scaled(node.share));
            let behind = rim.point(span - rear.scaled(node.share));
            // Equation 8 gives the point behind the peak the normal stress of the point ahead of it.
            let normal_pa = normal.at(ahead.sunk);
            let held = strength.at(normal_pa);
            for (point, width) in [(&ahead, front), (&behind, rear)] {
                let traction = law.at(&held, &Slide::at(displacement, point));
                let stand = Stand { unit: S::one(), cos: point.cos, sin: point.sin };
                sum += Integrals::of(normal_pa, &traction, &stand).times(width.scaled(node.weight));
            }
        }
    }
    sum
}

impl<S: Scalar> Place<'_, S> {
    /// Where the contact is divided. The integrals do not depend on it, so that it needs no derivatives.
    pub fn panels(&self, quadrature: &Quadrature) -> Panels<S::Plain> {
        let contact = self.contact.plain();
        let displacement = ShearDisplacement::new(self.displacement.slip().plain());
        let thickness = quadrature.layer::<S::Plain>() * self.layer.plain();
        Panels::new(quadrature, &contact, &Rim::new(contact.entry_rad), &ShearLayer { displacement, thickness })
    }
}

impl<S: Scalar> Integrals<S> {
    /// Nothing.
    pub fn zero() -> Self {
        Self { pull: S::zero(), load: S::zero(), torque: S::zero(), side: S::zero() }
    }

    /// The integrand of equations 3–5: linear in the stresses, and in how the rim stands.
    #[inline(always)]
    pub fn of(normal_pa: S, traction: &Traction<S>, stand: &Stand<S>) -> Self {
        Self {
            pull: traction.along_pa * stand.cos - normal_pa * stand.sin,
            load: normal_pa * stand.cos + traction.along_pa * stand.sin,
            torque: traction.turning_pa * stand.unit,
            side: traction.across_pa * stand.unit,
        }
    }

    /// The same in another scalar.
    pub fn map<T>(self, convert: impl Fn(S) -> T) -> Integrals<T> {
        Integrals {
            pull: convert(self.pull),
            load: convert(self.load),
            torque: convert(self.torque),
            side: convert(self.side),
        }
    }

    /// As many times as much.
    #[inline(always)]
    pub fn times(&self, factor: S) -> Self {
        Self {
            pull: factor * self.pull,
            load: factor * self.load,
            torque: factor * self.torque,
            side: factor * self.side,
        }
    }
}

impl<S: Scalar> Add for Integrals<S> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl<S: Scalar> AddAssign for Integrals<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        self.pull += other.pull;
        self.load += other.load;
        self.torque += other.torque;
        self.side += other.side;
    }
}
