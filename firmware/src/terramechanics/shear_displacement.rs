//! How far the rim has sheared the soil: equation 2, driving and braking.

use crate::scalar::Scalar;

use super::Contact;
use super::rim::{Rim, RimPoint};

/// Shear displacement along the rim, j = r [(θ₁ − θ) − V (sin θ₁ − sin θ)] with V = v/(rω).
///
/// V is 1 − i when driving and 1/(1 + i) when braking, so that a locked wheel (i = −1) shears without bound. Both sides
/// are multiplied by a = 1 (driving) or a = 1 + i (braking) to stay finite there: q = a j / r is
/// i (θ₁ − θ) + b [(θ₁ − θ) − (sin θ₁ − sin θ)], b = aV, in which nothing cancels at small slip.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ShearDisplacement<S> {
    slip: S,
    /// a: 1 driving, 1 + i braking.
    pub rim_share: S,
    /// b = aV: 1 − i driving, 1 braking.
    ground_share: S,
}

impl<S: Scalar> ShearDisplacement<S> {
    /// The displacement at a slip of −1 … 1.
    pub fn new(slip: S) -> Self {
        if slip < S::zero() {
            Self { slip, rim_share: S::one() + slip, ground_share: S::one() }
        } else {
            Self { slip, rim_share: S::one(), ground_share: S::one() - slip }
        }
    }

    /// The slip that it is at.
    pub fn slip(&self) -> S {
        self.slip
    }

    /// q = a j / r at a point.
    #[inline(always)]
    pub fn at(&self, point: &RimPoint<S>) -> S {
        self.slip * point.from_entry_rad + self.ground_share * (point.from_entry_rad - point.behind)
    }

    /// The same across the wheel per tangent of the slip angle: a j_y / (r tan β) = aV (θ₁ − θ).
    #[inline(always)]
    pub fn across(&self, point: &RimPoint<S>) -> S {
        self.ground_share * point.from_entry_rad
    }

    /// dq/dx at a point, x = θ₁ − θ.
    pub fn slope(&self, point: &RimPoint<S>) -> S {
        self.rim_share - self.ground_share * point.cos
    }

    /// d²q/dx² at a point.
    pub fn curvature(&self, point: &RimPoint<S>) -> S {
        -(self.ground_share * point.sin)
    }

    /// The angle α = arccos(a/b) when braking: j falls towards the rear where |θ| < α, and rises elsewhere.
    pub fn turn_rad(&self) -> Option<S> {
        (self.slip < S::zero()).then(|| self.rim_share.acos())
    }

    /// The places (as θ₁ − θ) behind the entry where j changes its sign: none when driving, at most two when braking.
    ///
    /// The first zero lies where q falls: Newton's method runs to it from one side from θ = 0, the point of inflection.
    /// The second lies behind −α, where q is convex: Newton's method does the same from the exit. A handful of steps is
    /// enough, as the places only divide the integral.
    pub fn sign_changes(&self, rim: &Rim<S>, contact: &Contact<S>) -> [Option<S>; 2] {
        let Some(turn_rad) = self.turn_rad() else {
            return [None, None];
        };
        let (entry, exit) = (contact.entry_rad, contact.span_rad());
        let (fall_start, fall_end) = ((entry - turn_rad).max(S::zero()), (entry + turn_rad).min(exit));
        let backward_at_fall_end = self.at(&rim.point(fall_end)) < S::zero();
        let forward_at_exit = self.at(&rim.point(exit)) > S::zero();
        [
            (entry > turn_rad && backward_at_fall_end).then(|| self.zero(rim, entry, fall_start, fall_end)),
            (backward_at_fall_end && forward_at_exit).then(|| self.zero(rim, exit, fall_end, exit)),
        ]
    }

    /// The zero of q in `low … high` (as θ₁ − θ), by Newton's method from a start it runs from monotonically.
    fn zero(&self, rim: &Rim<S>, start: S, low: S, high: S) -> S {
        const STEPS: usize = 6;
        let mut x = start;
        for _ in 0..STEPS {
            let point = rim.point(x);
            let slope = self.slope(&point);
            if slope.abs() > S::zero() {
                x = (x - self.at(&point) / slope).max(low).min(high);
            }
        }
        x
    }
}
