//! Where the integrals over the contact are divided.

use crate::scalar::Scalar;

use super::Contact;
use super::quadrature::Quadrature;
use super::rim::{Rim, RimPoint};
use super::shear_displacement::ShearDisplacement;

/// At most this many panels: divided at the end of the entry's shear layer, at the two angles where j turns, and at each
/// of two zeros of j and the ends of its layer.
const MOST_PANELS: usize = 10;

/// The ends of the panels in the graded coordinate t, 0 … 1, rising; panels of no length are to be passed over.
#[derive(Debug, Clone, Copy)]
pub(super) struct Panels<S> {
    ends: [S; MOST_PANELS],
}

impl<S: Scalar> Panels<S> {
    /// Divides a contact so that each panel holds a smooth integrand.
    pub fn new(quadrature: &Quadrature, contact: &Contact<S>, rim: &Rim<S>, shear: &ShearLayer<S>) -> Self {
        let mut panels = Self { ends: [S::one(); MOST_PANELS] };
        let mut divide = |from_entry_rad: S| {
            let share = contact.share(from_entry_rad);
            if share > S::zero() && share < S::one() {
                panels.insert(quadrature.coordinate(share));
            }
        };
        if let Some(behind) = shear.reach_behind(&rim.point(S::zero())) {
            divide(behind);
        }
        if let Some(turn_rad) = shear.displacement.turn_rad() {
            divide(contact.entry_rad - turn_rad);
            divide(contact.entry_rad + turn_rad);
        }
        for zero in shear.displacement.sign_changes(rim, contact).into_iter().flatten() {
            let point = rim.point(zero);
            divide(zero);
            if let Some(behind) = shear.reach_behind(&point) {
                divide(zero + behind);
            }
            if let Some(ahead) = shear.reach_ahead(&point) {
                divide(zero - ahead);
            }
        }
        panels
    }

    /// The panels, as (start, length).
    pub fn iter(&self) -> impl Iterator<Item = (S, S)> + '_ {
        let starts = core::iter::once(S::zero()).chain(self.ends.iter().copied());
        starts
            .zip(self.ends.iter().copied())
            .map(|(start, end)| (start, end - start))
            .filter(|panel| panel.1 > S::zero())
    }

    /// Puts an end in its place; the last of the ones that fill the list falls off.
    fn insert(&mut self, end: S) {
        let mut carried = end;
        for slot in &mut self.ends {
            if carried < *slot {
                core::mem::swap(slot, &mut carried);
            }
        }
    }
}

/// The layer around a zero of j in which shear is not yet mobilised.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShearLayer<S> {
    /// The displacement q.
    pub displacement: ShearDisplacement<S>,
    /// The q at which shear counts as mobilised.
    pub thickness: S,
}

impl<S: Scalar> ShearLayer<S> {
    /// How far behind a zero of q its layer ends, rad.
    fn reach_behind(&self, zero: &RimPoint<S>) -> Option<S> {
        reach(self.displacement.slope(zero), self.displacement.curvature(zero), self.thickness)
    }

    /// How far ahead of a zero of q its layer ends, rad.
    fn reach_ahead(&self, zero: &RimPoint<S>) -> Option<S> {
        reach(-self.displacement.slope(zero), self.displacement.curvature(zero), self.thickness)
    }
}

/// The distance at which a parabola through zero with this slope and curvature reaches ±`thickness`, if it does before
/// it turns.
fn reach<S: Scalar>(slope: S, curvature: S, thickness: S) -> Option<S> {
    let (slope, curvature) = if slope < S::zero() { (-slope, -curvature) } else { (slope, curvature) };
    let squared = slope * slope + S::constant(2.0) * curvature * thickness;
    let sum = slope + squared.max(S::zero()).sqrt();
    (squared > S::zero() && sum > S::zero()).then(|| S::constant(2.0) * thickness / sum)
}
