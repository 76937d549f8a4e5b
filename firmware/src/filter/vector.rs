//! Rows of numbers, always worked through in the order of their indices, so that rounding is the same everywhere.

use core::array::from_fn;

use crate::scalar::Scalar;

/// Σ aᵢ bᵢ, in the order of the indices.
#[inline]
pub(super) fn dot<T: Scalar>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).fold(T::zero(), |sum, (a, b)| sum + *a * *b)
}

/// Whether every number is finite: nought times a finite number is zero, nought times any other is not a number.
#[inline]
pub(super) fn all_finite<T: Scalar>(numbers: &[T]) -> bool {
    numbers.iter().fold(T::zero(), |sum, number| sum + *number * T::zero()) == T::zero()
}

/// The matrix with these entries on its diagonal.
pub(super) fn diagonal<T: Scalar, const N: usize>(entries: &[T; N]) -> [[T; N]; N] {
    let mut matrix = [[T::zero(); N]; N];
    for (index, (column, entry)) in matrix.iter_mut().zip(entries).enumerate() {
        if let Some(place) = column.get_mut(index) {
            *place = *entry;
        }
    }
    matrix
}

/// The transposed matrix.
#[inline]
pub(super) fn transposed<T: Scalar, const A: usize, const B: usize>(matrix: &[[T; B]; A]) -> [[T; A]; B] {
    let entry = |row: usize, column: usize| matrix.get(row).and_then(|row| row.get(column)).copied();
    from_fn(|column| from_fn(|row| entry(row, column).unwrap_or_else(T::zero)))
}

/// `place` − `factor` · `other`
#[inline]
pub(super) fn subtract<T: Scalar>(place: &mut [T], factor: T, other: &[T]) {
    place.iter_mut().zip(other).for_each(|(place, entry)| *place -= factor * *entry);
}

/// `factor` · `place`
#[inline]
pub(super) fn scale<T: Scalar>(place: &mut [T], factor: T) {
    place.iter_mut().for_each(|entry| *entry = *entry * factor);
}
