//! Householder reflections that bring a tall matrix to its triangular root.

use crate::scalar::Scalar;

use super::vector::{dot, subtract};

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
    /// precision, and the reflection does nothing. Beyond 1e19 its square overflows; the new pivot is then no finite number,
    /// so that the step is seen to have failed.
    #[inline]
    pub fn new(pivot: T, column: &'a [T]) -> (Self, T) {
        let square = pivot * pivot + dot(column, column);
        let norm = square.sqrt();
        let head = pivot + norm;
        let half_length = norm * head;
        let factor = if square < T::constant(1e-36) { T::zero() } else { T::one() / half_length };
        // Adds zero, or what is not a number where the length of v overflows although the norm does not.
        (Self { column, head, factor }, norm + half_length * T::zero())
    }

    /// Reflects another column, whose entry in the pivot's row is zero; gives the new entry there.
    #[inline]
    pub fn apply(&self, other: &mut [T]) -> T {
        let share = dot(self.column, other) * self.factor;
        subtract(other, share, self.column);
        share * self.head
    }

    /// Reflects another column with this entry in the pivot's row; gives the new entry there.
    #[inline]
    pub fn apply_below(&self, entry: T, other: &mut [T]) -> T {
        let share = (entry * self.head + dot(self.column, other)) * self.factor;
        subtract(other, share, self.column);
        share * self.head - entry
    }
}

/// The upper triangular R with RᵀR = diag(`pivots`)² + AᵀA, where `rows` gives the rows of A in each of `columns`.
///
/// The diagonal of R is at least |`pivots`|, whatever A is. Row `k` of R is written to entry `k` of `root`. A is used up.
///
/// Cost: a square root and a division a column; N² multiplications with addition for each row of A.
#[inline]
pub(super) fn triangularise<T: Scalar, C, const N: usize>(
    pivots: &[T; N],
    columns: &mut [C; N],
    rows: impl Fn(&mut C) -> &mut [T],
    root: &mut [[T; N]; N],
) {
    let mut rest = columns.as_mut_slice();
    for (index, (row, pivot)) in root.iter_mut().zip(pivots).enumerate() {
        let Some((column, later)) = rest.split_first_mut() else { break };
        *row = [T::zero(); N];
        let Some((diagonal, entries)) = row.get_mut(index..).and_then(<[T]>::split_first_mut) else { break };
        let (reflection, norm) = Reflection::new(pivot.abs(), rows(column));
        *diagonal = norm;
        for (entry, other) in entries.iter_mut().zip(later.iter_mut()) {
            *entry = reflection.apply(rows(other));
        }
        rest = later;
    }
}
