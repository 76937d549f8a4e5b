//! Householder reflections that bring a tall matrix to its triangular root.

use crate::scalar::Scalar;

use super::gaussian::dot;

/// The reflection that folds a column `a` below a pivot ρ ≥ 0 into the pivot: (ρ, a) becomes (√(ρ² + aᵀa), 0).
///
/// It is the Householder reflection with its sign turned, so that every pivot stays positive; v = (ρ + √…, a) has no cancellation.
pub(super) struct Reflection<'a, T> {
    column: &'a [T],
    /// The first entry of v.
    head: T,
    /// 2 / vᵀv.
    factor: T,
}

impl<'a, T: Scalar> Reflection<'a, T> {
    /// The reflection for a pivot and the column below it, with the new pivot.
    ///
    /// A column whose norm, pivot included, is below 1e-18 counts as zero: the squares of its entries are lost in single
    /// precision, and the reflection does nothing.
    #[inline]
    pub fn new(pivot: T, column: &'a [T]) -> (Self, T) {
        let square = pivot * pivot + dot(column, column);
        let norm = square.sqrt();
        let head = pivot + norm;
        let factor = if square < T::constant(1e-36) { T::zero() } else { T::one() / (norm * head) };
        (Self { column, head, factor }, norm)
    }

    /// Reflects another column, whose entry in the pivot's row is zero; gives the new entry there.
    #[inline]
    pub fn apply(&self, other: &mut [T]) -> T {
        let share = dot(self.column, other) * self.factor;
        self.subtract(share, other);
        share * self.head
    }

    /// Reflects another column with this entry in the pivot's row; gives the new entry there.
    #[inline]
    pub fn apply_below(&self, entry: T, other: &mut [T]) -> T {
        let share = (entry * self.head + dot(self.column, other)) * self.factor;
        self.subtract(share, other);
        share * self.head - entry
    }

    #[inline]
    fn subtract(&self, share: T, other: &mut [T]) {
        other.iter_mut().zip(self.column).for_each(|(place, entry)| *place -= share * *entry);
    }
}

/// A triangular root, and what the reflections made of a column beside it.
pub(super) struct Triangle<T, const N: usize> {
    /// Row `k` of R is entry `k`, zero left of its place `k`.
    pub root: [[T; N]; N],
    /// The column beside R.
    pub beside: [T; N],
}

/// The upper triangular R with RᵀR = diag(`pivots`)² + AᵀA, where A is given by its columns of `B` blocks of `K` rows.
///
/// The diagonal of R is at least |`pivots`|, whatever A is. `carried`, a column of as many rows as A, is reflected along:
/// it keeps what lies outside the columns of A, and the rest is in [`Triangle::beside`]. A is used up.
///
/// Cost: a square root and a division a column, N² K B multiplications with addition.
#[inline]
pub(super) fn triangularise<T: Scalar, const K: usize, const B: usize, const N: usize>(
    pivots: &[T; N],
    columns: &mut [[[T; K]; B]; N],
    carried: &mut [T],
) -> Triangle<T, N> {
    let mut triangle = Triangle { root: [[T::zero(); N]; N], beside: [T::zero(); N] };
    let mut rest = columns.as_mut_slice();
    let rows = triangle.root.iter_mut().zip(&mut triangle.beside);
    for (index, ((row, beside), pivot)) in rows.zip(pivots).enumerate() {
        let Some((column, trailing)) = rest.split_first_mut() else { break };
        let (reflection, norm) = Reflection::new(pivot.abs(), column.as_flattened());
        let mut entries = row.iter_mut().skip(index);
        if let Some(diagonal) = entries.next() {
            *diagonal = norm;
        }
        for (entry, other) in entries.zip(trailing.iter_mut()) {
            *entry = reflection.apply(other.as_flattened_mut());
        }
        *beside = reflection.apply(carried);
        rest = trailing;
    }
    triangle
}

/// Solves X R = A for X, in place: `columns` are those of A, then of X; row `k` of `root` is row `k` of the upper triangular R.
///
/// Cost: a division a column, K N²/2 multiplications with addition.
#[inline]
pub(super) fn divide_by_triangle<T: Scalar, const K: usize, const N: usize>(
    columns: &mut [[T; K]; N],
    root: &[[T; N]; N],
) {
    let mut rest = columns.as_mut_slice();
    for (index, row) in root.iter().enumerate() {
        let Some((column, trailing)) = rest.split_first_mut() else { break };
        let mut entries = row.iter().skip(index);
        if let Some(diagonal) = entries.next() {
            let inverse = T::one() / *diagonal;
            column.iter_mut().for_each(|entry| *entry = *entry * inverse);
        }
        for (factor, other) in entries.zip(trailing.iter_mut()) {
            other.iter_mut().zip(column.iter()).for_each(|(place, entry)| *place -= *factor * *entry);
        }
        rest = trailing;
    }
}
