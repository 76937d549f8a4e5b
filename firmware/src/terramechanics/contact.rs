//! Where the rim touches the soil: equations 9–11.

use crate::scalar::Scalar;

use super::{Soil, Wheel};

/// The contact angles on the rim, rad, from the downward vertical and positive forward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact<S> {
    /// Entry angle θ₁ > 0, equation 9.
    pub entry_rad: S,
    /// Angle of the peak stress θm, equation 10, kept just inside the contact: see [`Contact::new`].
    pub peak_rad: S,
    /// Exit angle θ₂ ≤ 0, equation 11.
    pub exit_rad: S,
}

impl<S: Scalar> Contact<S> {
    /// The contact of a wheel at the given slip and sinkage (m, 0 … r), equations 9–11.
    ///
    /// Equation 10 puts the peak stress outside the contact where c₁ + c₂ i is negative or above one (skidding does it
    /// to many soils). The peak is then held inside by one millionth of the contact's length: the region that vanishes
    /// keeps a width, and the forces are those of the limit to about as much.
    pub fn new(wheel: &Wheel<S>, soil: &Soil<S>, slip: S, sinkage_m: S) -> Self {
        Self::free(wheel, soil, slip, sinkage_m).held()
    }

    /// The same with the peak where equation 10 puts it, be that outside the contact.
    pub(super) fn free(wheel: &Wheel<S>, soil: &Soil<S>, slip: S, sinkage_m: S) -> Self {
        let depth = sinkage_m / wheel.radius_m;
        let entry_rad = rim_angle(depth);
        let exit_rad = -rim_angle(soil.rebound_ratio * depth);
        let peak_rad = (soil.peak_stress_c1 + soil.peak_stress_c2 * slip) * entry_rad;
        Self { entry_rad, peak_rad, exit_rad }
    }

    /// The same without what the scalar carries along.
    pub(super) fn plain(&self) -> Contact<S::Plain> {
        Contact { entry_rad: self.entry_rad.plain(), peak_rad: self.peak_rad.plain(), exit_rad: self.exit_rad.plain() }
    }

    /// The same with the peak held inside the contact.
    pub(super) fn held(self) -> Self {
        let margin = S::constant(1e-6) * self.span_rad();
        let peak_rad = self.peak_rad.max(self.exit_rad + margin).min(self.entry_rad - margin);
        Self { peak_rad, ..self }
    }

    /// The angle in front of the peak stress, rad.
    pub(super) fn front_rad(&self) -> S {
        self.entry_rad - self.peak_rad
    }

    /// The angle behind the peak stress, rad.
    pub(super) fn rear_rad(&self) -> S {
        self.peak_rad - self.exit_rad
    }

    /// The whole angle of contact, rad.
    pub(super) fn span_rad(&self) -> S {
        self.entry_rad - self.exit_rad
    }

    /// The place θ₁ − `from_entry_rad` as a share of its side of the contact: 0 at the end, 1 at the peak.
    pub(super) fn share(&self, from_entry_rad: S) -> S {
        if from_entry_rad < self.front_rad() {
            from_entry_rad / self.front_rad()
        } else {
            (self.span_rad() - from_entry_rad) / self.rear_rad()
        }
    }
}

/// arccos(1 − `depth`), for a depth of 0 … 2 in radii.
///
/// 1 − depth drops the last digits of a small depth. The sine does not (it is a bound from below as well), and a Newton
/// step on depth = 2 sin²(θ/2) brings them back.
pub(crate) fn rim_angle<S: Scalar>(depth: S) -> S {
    let sine = (depth * (S::constant(2.0) - depth)).sqrt();
    let angle = (S::one() - depth).acos().max(sine);
    let half_sine = (S::constant(0.5) * angle).sin();
    let missing = depth - S::constant(2.0) * half_sine * half_sine;
    if sine > S::zero() { angle + missing / sine } else { angle }
}
