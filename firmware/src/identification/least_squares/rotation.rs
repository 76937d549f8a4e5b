//! Equations taken in one by one, by plane rotations.

use crate::scalar::Scalar;

/// A plane rotation that brings the second number to zero.
#[derive(Debug, Clone, Copy)]
struct Rotation<S> {
    cos: S,
    sin: S,
}

impl<S: Scalar> Rotation<S> {
    /// None where there is nothing to bring to zero.
    fn new(first: Option<&S>, second: Option<&S>) -> Option<Self> {
        let (first, second) = (*first?, *second?);
        if second == S::zero() {
            return None;
        }
        // Scaled: the square of a large residual's slope overflows in single precision.
        let scale = first.abs().max(second.abs());
        let (a, b) = (first / scale, second / scale);
        let length = (a * a + b * b).sqrt();
        Some(Self { cos: a / length, sin: b / length })
    }

    /// Turns a pair.
    fn apply(&self, first: &mut S, second: &mut S) {
        let (a, b) = (*first, *second);
        *first = self.cos * a + self.sin * b;
        *second = self.cos * b - self.sin * a;
    }
}

/// Takes an equation into a triangular root by rotations: `row` and `value` become what the root does not tell of them.
/// The root's rows may be longer than they are many.
pub(in crate::identification) fn take_in<S: Scalar, const C: usize>(
    root: &mut [[S; C]],
    right: &mut [S],
    row: &mut [S; C],
    value: &mut S,
) {
    for (place, (known, right)) in root.iter_mut().zip(right).enumerate() {
        let Some(rotation) = Rotation::new(known.get(place), row.get(place)) else { continue };
        for (above, below) in known.iter_mut().zip(&mut *row).skip(place) {
            rotation.apply(above, below);
        }
        rotation.apply(right, value);
    }
}
