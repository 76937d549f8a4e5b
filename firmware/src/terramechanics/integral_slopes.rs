//! The integrals of equations 3–5 with their slopes, in fewer operations than with slopes carried through each.
//!
//! A force may have slopes by a dozen variables, but it follows from these through few numbers: the contact angles, the
//! pressure law's stiffness and exponent, the slip, the strength, and what the law of shear is made of. The integrals are
//! summed up with their changes by these, and these once, at the end, joined to the variables.

use crate::dual::Dual;
use crate::scalar::Scalar;

use super::Contact;
use super::integrals::{Integrals, Place};
use super::panels::Panels;
use super::point_slopes::{CAPPED, Steps, UNCAPPED};
use super::quadrature::{PlacedNode, Quadrature};
use super::shear_law::ShearLaw;

/// Integrates the stresses over the contact, in panels.
pub(super) fn with_slopes<S: Scalar, L: ShearLaw<S>>(
    quadrature: &Quadrature,
    panels: &Panels<S::Plain>,
    place: &Place<'_, S>,
    law: &L,
) -> Integrals<S> {
    // Each variable of the law costs time at each point: as few as the plain law has, as a law of two numbers without a cap,
    // or as any.
    if !L::IS_SIDEWAYS {
        chained::<S, L, 3, UNCAPPED>(quadrature, panels, place, law)
    } else if place.strength.is_capped() || count(law) > 2 {
        chained::<S, L, 10, CAPPED>(quadrature, panels, place, law)
    } else {
        chained::<S, L, 5, UNCAPPED>(quadrature, panels, place, law)
    }
}

/// The numbers that a law is made of.
fn count<S: Scalar>(law: &impl ShearLaw<S>) -> usize {
    let mut count = 0;
    law.map(|number| {
        count += 1;
        number
    });
    count
}

/// The same, with `K` variables of the law and `H` of the strength.
fn chained<S: Scalar, L: ShearLaw<S>, const K: usize, const H: usize>(
    quadrature: &Quadrature,
    panels: &Panels<S::Plain>,
    place: &Place<'_, S>,
    law: &L,
) -> Integrals<S> {
    let contact = place.contact.plain();
    let steps = Steps::new(place, law);
    let mut sums = Sums::<S::Plain, K, H>::zero();
    for (start, length) in panels.iter() {
        for node in quadrature.place(start, length) {
            sums.add(&steps, &contact, &node);
        }
    }
    sums.joined(place, law)
}

/// The integrals, and how they change with what they follow from.
struct Sums<S, const K: usize, const H: usize> {
    value: Integrals<S>,
    by_front: Integrals<S>,
    by_rear: Integrals<S>,
    by_span: Integrals<S>,
    by_entry: Integrals<S>,
    by_one_radius: Integrals<S>,
    by_exponent: Integrals<S>,
    by_slip: Integrals<S>,
    /// By the numbers of the strength, in their order.
    by_strength: [Integrals<S>; H],
    /// By those of the law.
    by_law: [Integrals<S>; K],
}

impl<S: Scalar, const K: usize, const H: usize> Sums<S, K, H> {
    fn zero() -> Self {
        let zero = Integrals::zero();
        Self {
            value: zero,
            by_front: zero,
            by_rear: zero,
            by_span: zero,
            by_entry: zero,
            by_one_radius: zero,
            by_exponent: zero,
            by_slip: zero,
            by_strength: [zero; H],
            by_law: [zero; K],
        }
    }

    /// Adds the two points of a node.
    #[inline(always)]
    fn add<L: ShearLaw<Dual<S, K>>>(&mut self, steps: &Steps<S, L, K, H>, contact: &Contact<S>, node: &PlacedNode<S>) {
        let (front, rear, span) = (contact.front_rad(), contact.rear_rad(), contact.span_rad());
        let ahead = steps.rim.point(Dual::variable(front * node.share, 0));
        let behind = steps.rim.point(Dual::variable(span - rear * node.share, 0));
        // Equation 8 gives the point behind the peak the normal stress of the point ahead of it.
        let normal = steps.normal.at(Dual::variable(ahead.sunk.value, 0));
        let held = steps.strength.at(Dual::variable(normal.value, 0));
        let under = (normal.value, &held);
        let (of_front, of_rear) = (node.weight * front, node.weight * rear);
        let first = steps.point(under, &ahead, of_front, &mut self.by_law);
        let second = steps.point(under, &behind, of_rear, &mut self.by_law);
        // In the order of the sum without slopes: it has the same bits.
        self.value += first.value.times(of_front);
        self.value += second.value.times(of_rear);

        let mut by_normal = first.by_normal + second.by_normal;
        by_normal += self.hold(&held.strength_pa, first.by_strength + second.by_strength);
        if let Some(cap_pa) = &held.cap_pa {
            by_normal += self.hold(cap_pa, first.by_cap + second.by_cap);
        }
        let [by_sunk, by_one_radius, by_exponent] = normal.slopes;
        let [by_place, by_entry] = ahead.sunk.slopes;
        let by_sunk = by_normal.times(by_sunk);
        self.by_one_radius += by_normal.times(by_one_radius);
        self.by_exponent += by_normal.times(by_exponent);
        self.by_entry += by_sunk.times(by_entry) + first.by_entry + second.by_entry;
        self.by_slip += first.by_slip + second.by_slip;
        // The angle of a side moves its points, and is a factor of their weights.
        self.by_front += (by_sunk.times(by_place) + first.by_place).times(node.share) + first.value.times(node.weight);
        self.by_rear += second.by_place.times(-node.share) + second.value.times(node.weight);
        self.by_span += second.by_place;
    }

    /// Adds what comes through something that is held, by which the integrals change; returns what of it comes through the
    /// normal stress.
    #[inline(always)]
    fn hold(&mut self, held_pa: &Dual<S, H>, by_held: Integrals<S>) -> Integrals<S> {
        let mut slopes = held_pa.slopes.iter();
        let by_normal = slopes.next().map_or(Integrals::zero(), |slope| by_held.times(*slope));
        for (sum, slope) in self.by_strength.iter_mut().zip(slopes) {
            *sum += by_held.times(*slope);
        }
        by_normal
    }

    /// The integrals with the slopes of the scalar that place and law are given in.
    fn joined<T: Scalar<Plain = S>, L: ShearLaw<T>>(&self, place: &Place<'_, T>, law: &L) -> Integrals<T> {
        let contact = place.contact;
        let mut joined = self.value.map(T::from_plain);
        let mut follow = |input: T, by: Integrals<S>| {
            joined.pull.follow(&input, by.pull);
            joined.load.follow(&input, by.load);
            joined.torque.follow(&input, by.torque);
            if L::IS_SIDEWAYS {
                joined.side.follow(&input, by.side);
            }
        };
        follow(contact.front_rad(), self.by_front);
        follow(contact.rear_rad(), self.by_rear);
        follow(contact.span_rad(), self.by_span);
        follow(contact.entry_rad, self.by_entry);
        follow(place.normal.at_one_radius_pa, self.by_one_radius);
        follow(place.normal.exponent, self.by_exponent);
        follow(place.displacement.slip(), self.by_slip);
        let mut by_strength = self.by_strength.iter();
        place.strength.map(|number| follow(number, by_strength.next().copied().unwrap_or(Integrals::zero())));
        let mut by_law = self.by_law.iter();
        law.map(|number| {
            follow(number, by_law.next().copied().unwrap_or(Integrals::zero()));
            number
        });
        joined
    }
}

#[cfg(test)]
mod tests;
