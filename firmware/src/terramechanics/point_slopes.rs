//! What a point of the rim adds to the integrals of equations 3–5, and how that changes.
//!
//! Each step on the way is taken by the same functions as without slopes, on dual numbers with slopes by the step's own inputs
//! alone: two or three of the dozen that a force may have. The chain rule joins the steps.

use crate::dual::Dual;
use crate::scalar::Scalar;

use super::integrals::{Integrals, Place, Stand};
use super::normal_stress::NormalStress;
use super::rim::{Rim, RimPoint};
use super::shear_displacement::ShearDisplacement;
use super::shear_law::{ShearLaw, Slide, Traction};
use super::shear_stress::{Held, Strength};

/// Variables of a strength without a cap: the normal stress, cohesion and tan φ.
pub(super) const UNCAPPED: usize = 3;
/// With the two numbers of a cap.
pub(super) const CAPPED: usize = UNCAPPED + 2;

/// The steps at a point: law and strength with `K` and `H` variables.
pub(super) struct Steps<S, L, const K: usize, const H: usize> {
    /// By place on the rim and entry angle.
    pub rim: Rim<Dual<S, 2>>,
    /// By how far the point has sunk, the stress at a depth of one radius, and the exponent.
    pub normal: NormalStress<Dual<S, 3>>,
    /// By the normal stress and its own numbers.
    pub strength: Strength<Dual<S, H>>,
    /// By place on the rim, entry angle and slip.
    displacement: ShearDisplacement<Dual<S, 3>>,
    /// By what its inputs are here, in the order of [`Steps::STRENGTH`] and so on, and its own numbers.
    law: L,
}

/// What a point adds, and how that changes with what the point alone does not settle.
pub(super) struct PointSlopes<S> {
    /// Per unit of weight.
    pub value: Integrals<S>,
    /// With the normal stress while the strength stays.
    pub by_normal: Integrals<S>,
    pub by_strength: Integrals<S>,
    pub by_cap: Integrals<S>,
    /// With the angle from the entry.
    pub by_place: Integrals<S>,
    /// With the entry angle while that stays.
    pub by_entry: Integrals<S>,
    pub by_slip: Integrals<S>,
}

impl<S: Scalar, L: ShearLaw<Dual<S, K>>, const K: usize, const H: usize> Steps<S, L, K, H> {
    /// Places of the law's inputs among its variables; a law asks for the displacement along the axle or does not.
    const STRENGTH: usize = 0;
    const ALONG: usize = 1;
    const ACROSS: usize = 2;
    const CAP: usize = if L::IS_SIDEWAYS { 3 } else { 2 };
    /// Where its own numbers begin.
    const OWN: usize = if H == CAPPED { Self::CAP + 1 } else { Self::CAP };

    /// At a place, by a law that is given in any scalar over this one.
    pub fn new<T: Scalar<Plain = S>>(place: &Place<'_, T>, law: &impl ShearLaw<T, In<Dual<S, K>> = L>) -> Self {
        let (mut of_strength, mut of_law) = (1.., Self::OWN..);
        Self {
            rim: Rim::new(Dual::variable(place.contact.entry_rad.plain(), 1)),
            normal: NormalStress {
                at_one_radius_pa: Dual::variable(place.normal.at_one_radius_pa.plain(), 1),
                exponent: Dual::variable(place.normal.exponent.plain(), 2),
            },
            strength: place.strength.map(|number| Dual::variable(number.plain(), of_strength.next().unwrap_or(H))),
            displacement: ShearDisplacement::new(Dual::variable(place.displacement.slip().plain(), 2)),
            law: law.map(|number| Dual::variable(number.plain(), of_law.next().unwrap_or(K))),
        }
    }

    /// What a point adds under a normal stress with what is held under it, at a weight; the changes with the law's own numbers
    /// are added to `by_law`.
    #[inline(always)]
    pub fn point(
        &self,
        (normal_pa, held): (S, &Held<Dual<S, H>>),
        point: &RimPoint<Dual<S, 2>>,
        weight: S,
        by_law: &mut [Integrals<S>; K],
    ) -> PointSlopes<S> {
        let slide = Slide::at(&self.displacement, &with_slip(point));
        let traction = self.law.at(
            &Held {
                strength_pa: Dual::variable(held.strength_pa.value, Self::STRENGTH),
                cap_pa: held.cap_pa.map(|cap_pa| Dual::variable(cap_pa.value, Self::CAP)),
            },
            &Slide {
                along: Dual::variable(slide.along.value, Self::ALONG),
                across: Dual::variable(slide.across.value, if L::IS_SIDEWAYS { Self::ACROSS } else { K }),
            },
        );

        // The integrand is linear in the stresses, and so are its changes in theirs.
        let stand = Stand { unit: weight, cos: weight * point.cos.value, sin: weight * point.sin.value };
        let mut by_input = slopes(&traction).map(|slope| Integrals::of(S::zero(), &slope, &stand));
        let mut next = |is_input: bool| is_input.then(|| by_input.next()).flatten().unwrap_or(Integrals::zero());
        let (by_strength, by_along) = (next(true), next(true));
        let (by_across, by_cap) = (next(L::IS_SIDEWAYS), next(H == CAPPED));
        for (sum, by) in by_law.iter_mut().zip(by_input) {
            *sum += by;
        }

        let value = traction.map(|stress| stress.value);
        let [cos_by_place, cos_by_entry] = point.cos.slopes;
        let [sin_by_place, sin_by_entry] = point.sin.slopes;
        let turned = |cos, sin| {
            Integrals::of(normal_pa, &value, &Stand { unit: S::zero(), cos: weight * cos, sin: weight * sin })
        };
        let mut by_rim = [turned(cos_by_place, sin_by_place), turned(cos_by_entry, sin_by_entry), Integrals::zero()];
        for (by, along) in by_rim.iter_mut().zip(slide.along.slopes) {
            *by += by_along.times(along);
        }
        if L::IS_SIDEWAYS {
            for (by, across) in by_rim.iter_mut().zip(slide.across.slopes) {
                *by += by_across.times(across);
            }
        }
        let [by_place, by_entry, by_slip] = by_rim;

        let upright = Stand { unit: S::one(), cos: point.cos.value, sin: point.sin.value };
        PointSlopes {
            value: Integrals::of(normal_pa, &value, &upright),
            by_normal: Integrals::of(S::one(), &Traction::zero(), &stand),
            by_strength,
            by_cap,
            by_place,
            by_entry,
            by_slip,
        }
    }
}

/// How a traction changes with each variable.
#[inline(always)]
fn slopes<S: Scalar, const K: usize>(traction: &Traction<Dual<S, K>>) -> impl Iterator<Item = Traction<S>> {
    let Traction { along_pa, turning_pa, across_pa } = traction;
    along_pa.slopes.iter().zip(&turning_pa.slopes).zip(&across_pa.slopes).map(|((along, turning), across)| Traction {
        along_pa: *along,
        turning_pa: *turning,
        across_pa: *across,
    })
}

/// The same point, with slopes by the slip as well: it does not move with that.
#[inline(always)]
fn with_slip<S: Scalar>(point: &RimPoint<Dual<S, 2>>) -> RimPoint<Dual<S, 3>> {
    let lift = |number: Dual<S, 2>| {
        let [by_place, by_entry] = number.slopes;
        Dual { value: number.value, slopes: [by_place, by_entry, S::zero()] }
    };
    RimPoint {
        from_entry_rad: lift(point.from_entry_rad),
        sin: lift(point.sin),
        cos: lift(point.cos),
        sunk: lift(point.sunk),
        behind: lift(point.behind),
    }
}
