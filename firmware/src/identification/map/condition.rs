//! How unequally the observations tell the three parameters that are asked.

use crate::scalar::Scalar;

use super::super::singular_values::singular_values;
use super::problem::{Fit, Problem};
use super::unknowns::{MODULUS, UNKNOWNS};

/// Parameters that are asked: ln K, φ, ln c.
const ASKED: usize = UNKNOWNS - MODULUS;

/// Greatest over least singular value of the change of the whitened residuals with ln c, φ (rad) and ln K, once all else is
/// taken out that is unknown: true sinkages and slips, and, with what is believed of them, pressure law, position of the
/// peak stress and effects. Those of the three that are known are left out.
pub(super) fn condition_number<S: Scalar, const N: usize>(problem: &Problem<'_, S>, fit: &Fit<S, N>) -> S {
    let unknowns = problem.forward.unknowns;
    let mut triangle = fit.of_observations(S::zero(), |_, _| ());
    for place in (0..MODULUS).filter(|place| !unknowns.is_known(*place)) {
        triangle.add_alone(place, S::one(), S::zero());
    }
    // The lower end of the triangle is what the rows say of the last unknowns alone.
    let mut columns = [[S::zero(); ASKED]; ASKED];
    for (place, column) in columns.iter_mut().enumerate() {
        if unknowns.is_known(MODULUS + place) {
            continue;
        }
        let slope = unknowns.slope(MODULUS + place, &fit.state.point);
        for (slot, row) in column.iter_mut().zip(triangle.root.iter().skip(MODULUS)) {
            *slot = row.get(MODULUS + place).copied().unwrap_or(S::zero()) / slope;
        }
    }
    let lengths = singular_values(columns);
    let free = unknowns.beliefs.iter().skip(MODULUS).filter(|belief| !belief.is_known()).count();
    ratio(lengths, free)
}

/// Greatest over least of the `count` greatest lengths.
fn ratio<S: Scalar>(mut lengths: [S; ASKED], count: usize) -> S {
    lengths.sort_unstable_by(|a, b| b.partial_cmp(a).unwrap_or(core::cmp::Ordering::Equal));
    let (greatest, least) = (lengths.first(), lengths.get(count.saturating_sub(1)));
    match greatest.zip(least) {
        Some((greatest, least)) if *greatest > S::zero() => *greatest / least.max(S::constant(1e-30)),
        _ => S::one(),
    }
}
