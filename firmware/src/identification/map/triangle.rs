//! Least squares by orthogonal rotations: an upper triangle R and a right side, into which rows go one by one.
//!
//! RᵀR is the information matrix, but it is never formed: its condition number is the square of that of the rows, and single
//! precision has no digits for it.

use crate::scalar::Scalar;

/// The sum of squares |R x + b|² + a rest that no x changes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Triangle<S, const N: usize> {
    /// R by rows; zero below the diagonal, and nothing below zero on it.
    pub rows: [[S; N]; N],
    /// b.
    pub right: [S; N],
}

impl<S: Scalar, const N: usize> Triangle<S, N> {
    /// No row yet.
    pub fn empty() -> Self {
        Self { rows: [[S::zero(); N]; N], right: [S::zero(); N] }
    }

    /// Takes in the residual `row`·x + `right`.
    pub fn insert(&mut self, row: &[S; N], right: S) {
        let (mut row, mut right) = (*row, right);
        for (place, (own, own_right)) in self.rows.iter_mut().zip(&mut self.right).enumerate() {
            let Some(rotation) = Rotation::new(own.get(place), row.get(place)) else { continue };
            for (a, b) in own.iter_mut().zip(&mut row).skip(place) {
                rotation.apply(a, b);
            }
            rotation.apply(own_right, &mut right);
        }
    }

    /// The x that makes R x + b zero; zero in the components that no row knows of.
    pub fn solve(&self) -> [S; N] {
        let mut x = [S::zero(); N];
        for (place, (row, right)) in self.rows.iter().zip(&self.right).enumerate().rev() {
            let mut sum = -*right;
            for (entry, known) in row.iter().zip(&x).skip(place + 1) {
                sum -= *entry * *known;
            }
            let pivot = row.get(place).copied().unwrap_or(S::zero());
            if let (Some(slot), true) = (x.get_mut(place), pivot > S::zero()) {
                *slot = sum / pivot;
            }
        }
        x
    }

    /// Gradient of half the sum of squares at x = 0: Rᵀ b.
    pub fn gradient(&self) -> [S; N] {
        let mut gradient = [S::zero(); N];
        for (row, right) in self.rows.iter().zip(&self.right) {
            for (slot, entry) in gradient.iter_mut().zip(row) {
                *slot += *entry * *right;
            }
        }
        gradient
    }

    /// A column of (RᵀR)⁻¹: products of the rows of R⁻¹.
    pub fn covariances(&self, place: usize) -> [S; N] {
        let own = self.inverse_row(place);
        core::array::from_fn(|other| product(&own, &self.inverse_row(other)))
    }

    /// The diagonal of (RᵀR)⁻¹.
    pub fn variances(&self) -> [S; N] {
        core::array::from_fn(|place| {
            let row = self.inverse_row(place);
            product(&row, &row)
        })
    }

    /// A row of R⁻¹: y with yᵀ R = eᵀ.
    fn inverse_row(&self, place: usize) -> [S; N] {
        let mut y = [S::zero(); N];
        for column in place..N {
            let mut sum = if column == place { S::one() } else { S::zero() };
            for (known, row) in y.iter().zip(&self.rows).take(column).skip(place) {
                sum -= *known * row.get(column).copied().unwrap_or(S::zero());
            }
            let pivot = self.rows.get(column).and_then(|row| row.get(column)).copied().unwrap_or(S::zero());
            if let (Some(slot), true) = (y.get_mut(column), pivot > S::zero()) {
                *slot = sum / pivot;
            }
        }
        y
    }

    /// ln |det R| over the components that some row knows of.
    pub fn ln_determinant(&self) -> S {
        let mut sum = S::zero();
        for (place, row) in self.rows.iter().enumerate() {
            if let Some(pivot) = row.get(place).filter(|pivot| **pivot > S::zero()) {
                sum += pivot.ln();
            }
        }
        sum
    }
}

fn product<S: Scalar>(a: &[S], b: &[S]) -> S {
    let mut sum = S::zero();
    for (x, y) in a.iter().zip(b) {
        sum += *x * *y;
    }
    sum
}

/// A plane rotation that brings the second number to zero.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rotation<S> {
    cos: S,
    sin: S,
}

impl<S: Scalar> Rotation<S> {
    /// None where there is nothing to bring to zero.
    pub fn new(first: Option<&S>, second: Option<&S>) -> Option<Self> {
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
    pub fn apply(&self, first: &mut S, second: &mut S) {
        let (a, b) = (*first, *second);
        *first = self.cos * a + self.sin * b;
        *second = self.cos * b - self.sin * a;
    }
}
