//! A bracketed root that cannot fail to end.

use crate::scalar::Scalar;

/// Two arguments with values of opposite sign: (argument, value), the value below zero at `low`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bracket<S> {
    pub low: (S, S),
    pub high: (S, S),
}

/// A root in the bracket, to |value| ≤ `tolerance` or to the last digits of the argument.
///
/// Regula falsi with the weight of Anderson and Björck, which converges faster than a secant; where three steps in a row
/// have not halved the bracket, a bisection does. So the bracket shrinks to nothing in a bounded number of steps whatever the function.
pub(super) fn solve<S: Scalar, E>(
    bracket: Bracket<S>,
    tolerance: S,
    value: impl Fn(S) -> Result<S, E>,
) -> Result<S, E> {
    const STEPS: usize = 200;
    let half = S::constant(0.5);
    let Bracket { mut low, mut high } = bracket;
    let mut best = if low.1.abs() < high.1.abs() { low } else { high };
    let (mut reference, mut since_halved) = (high.0 - low.0, 0);
    for _ in 0..STEPS {
        let width = high.0 - low.0;
        if best.1.abs() <= tolerance || width <= S::constant(S::EPSILON) * high.0 {
            break;
        }
        if width <= half * reference {
            (reference, since_halved) = (width, 0);
        }
        let middle = low.0 + half * width;
        let secant = high.0 - high.1 * (width / (high.1 - low.1));
        let inside = secant > low.0 && secant < high.0;
        let next = if inside && since_halved < 3 { secant } else { middle };
        since_halved += 1;
        let found = (next, value(next)?);
        if found.1.abs() < best.1.abs() {
            best = found;
        }
        let (end, other) = if found.1 < S::zero() { (&mut low, &mut high) } else { (&mut high, &mut low) };
        let ratio = S::one() - found.1 / end.1;
        other.1 = other.1 * if ratio > S::zero() { ratio } else { half };
        *end = found;
    }
    Ok(best.0)
}
