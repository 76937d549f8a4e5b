//! A growth that saturates.

use crate::scalar::Scalar;

/// (1 − e^(−ax))/a: as x at first, and never more than 1/a, for a rate a of any sign.
pub(super) fn saturated<S: Scalar>(x: S, rate: S) -> S {
    let bend = rate * x;
    // The series where the difference would lose its digits.
    if bend.abs() < S::constant(1e-3) {
        x * (S::one() - S::constant(0.5) * bend)
    } else {
        (S::one() - (-bend).exp()) / rate
    }
}
