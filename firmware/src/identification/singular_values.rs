//! Singular values of three columns.

use crate::scalar::Scalar;

/// Three numbers.
type Column<S> = [S; 3];

/// The singular values, in no order: the lengths of the columns once they are turned among each other until they are at
/// right angles. One-sided Jacobi rotations (M. R. Hestenes, J. SIAM 6 (1958) 51–90) find small ones to their own digits;
/// three columns settle in a few sweeps.
pub(super) fn singular_values<S: Scalar>(mut columns: [Column<S>; 3]) -> [S; 3] {
    const SWEEPS: usize = 12;
    for _ in 0..SWEEPS {
        let [a, b, c] = &mut columns;
        turn(a, b);
        turn(a, c);
        turn(b, c);
    }
    columns.map(|column| dot(&column, &column).sqrt())
}

/// Turns two columns so that they are at right angles.
fn turn<S: Scalar>(first: &mut Column<S>, second: &mut Column<S>) {
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

fn dot<S: Scalar>(a: &Column<S>, b: &Column<S>) -> S {
    let mut sum = S::zero();
    for (x, y) in a.iter().zip(b) {
        sum += *x * *y;
    }
    sum
}
