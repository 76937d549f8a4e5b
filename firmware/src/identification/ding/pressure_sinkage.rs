//! Step 2: stiffness and exponent, from the normal stress at the peak.

use crate::identification::least_squares::Triangle;
use crate::scalar::Scalar;

use super::rows::{Sensitive, Traced};

/// The normal stress at a depth z: σ = K_s z^(n₀ + n₁ i).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PressureSinkage<S> {
    /// ln K_s, K_s in Pa/m^N.
    pub ln_stiffness: S,
    /// n₀.
    pub exponent: S,
    /// n₁.
    pub exponent_per_slip: S,
}

/// ln σm = ln K_s + (n₀ + n₁ i) ln(r (cos θm − cos θ₁)). None where the depths, or the slips, differ by no more than their
/// noise would make equal ones differ: a regression then gives the noise's slope.
pub(super) fn fit<S: Scalar>(rows: &Sensitive<'_, S>) -> Option<PressureSinkage<S>> {
    let mut regression = Triangle::<S, 3>::new();
    let (mut depth_noise, mut slip_noise) = (S::zero(), S::zero());
    for row in rows.iter() {
        let ln_depth = (Traced::fixed(rows.radius_m()) * row.stress.sunk).ln();
        let by_slip = row.slip * ln_depth;
        regression.add([S::one(), ln_depth.value, by_slip.value], row.stress.normal_pa.value.ln());
        depth_noise += row.variance(&ln_depth);
        slip_noise += row.variance(&by_slip);
    }
    let (depth, slip) = (regression.pivot(1), regression.pivot(2));
    if !(depth * depth > depth_noise && slip * slip > slip_noise) {
        return None;
    }
    let [ln_stiffness, exponent, exponent_per_slip] = regression.solution()?;
    Some(PressureSinkage { ln_stiffness, exponent, exponent_per_slip })
}
