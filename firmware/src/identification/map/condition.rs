//! How unequally the observations tell the three parameters that are asked.

use crate::scalar::Scalar;

use super::problem::{Fit, Problem, unit};
use super::unknowns::{MODULUS, UNKNOWNS};

/// Parameters that are asked: ln K, φ, ln c.
const ASKED: usize = UNKNOWNS - MODULUS;

/// Greatest over least singular value of the change of the whitened residuals with ln c, φ (rad) and ln K, once all else is
/// taken out that is unknown: true sinkages and slips, and, with what is believed of them, pressure law, position of the
/// peak stress and effects. Those of the three that are known are left out.
pub(super) fn condition_number<S: Scalar>(problem: &Problem<'_, S>, fit: &Fit<S>) -> S {
    let unknowns = problem.forward.unknowns;
    let (mut triangle, _) = fit.of_observations(S::zero());
    for place in (0..MODULUS).filter(|place| !unknowns.is_known(*place)) {
        triangle.insert(&unit(place, S::one()), S::zero());
    }
    // The lower end of the triangle is what the rows say of the last unknowns alone.
    let mut columns = [[S::zero(); ASKED]; ASKED];
    for (place, column) in columns.iter_mut().enumerate() {
        if unknowns.is_known(MODULUS + place) {
            continue;
        }
        let slope = unknowns.slope(MODULUS + place, &fit.state.point);
        for (slot, row) in column.iter_mut().zip(triangle.rows.iter().skip(MODULUS)) {
            *slot = row.get(MODULUS + place).copied().unwrap_or(S::zero()) / slope;
        }
    }
    let lengths = orthogonal(columns).map(|column| dot(&column, &column).sqrt());
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

/// The columns turned among each other until they are at right angles: one-sided Jacobi rotations (M. R. Hestenes,
/// J. SIAM 6 (1958) 51–90), which find small singular values to their own digits. Three columns settle in a few sweeps.
fn orthogonal<S: Scalar>(mut columns: [[S; ASKED]; ASKED]) -> [[S; ASKED]; ASKED] {
    const SWEEPS: usize = 12;
    for _ in 0..SWEEPS {
        let [a, b, c] = &mut columns;
        turn(a, b);
        turn(a, c);
        turn(b, c);
    }
    columns
}

/// Turns two columns so that they are at right angles.
fn turn<S: Scalar>(first: &mut [S; ASKED], second: &mut [S; ASKED]) {
    let (own, other, between) = (dot(first, first), dot(second, second), dot(first, second));
    if between == S::zero() {
        return;
    }
    let two = S::constant(2.0);
    let slope = (other - own) / (two * between);
    let size = S::one() / (slope.abs() + (S::one() + slope * slope).sqrt());
    let tan = if slope < S::zero() { -size } else { size };
    let cos = S::one() / (S::one() + tan * tan).sqrt();
    for (a, b) in first.iter_mut().zip(second.iter_mut()) {
        let (old_a, old_b) = (*a, *b);
        *a = cos * (old_a - tan * old_b);
        *b = cos * (old_b + tan * old_a);
    }
}

fn dot<S: Scalar>(a: &[S; ASKED], b: &[S; ASKED]) -> S {
    let mut sum = S::zero();
    for (x, y) in a.iter().zip(b) {
        sum += *x * *y;
    }
    sum
}
