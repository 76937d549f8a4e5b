//! Small systems of linear equations, each of a size that the compiler knows.

/// Solves (`left` + `known`) x = `right` for x, in place of `right`; of both matrices the diagonal and what is above it count.
#[inline(always)]
pub fn solve<const N: usize>(left: &mut [[f32; N]; N], known: &[[f32; N]; N], right: &mut [f32; N]) {
    const { assert!(N <= 6, "one line below for each pivot") };
    left.as_flattened_mut().iter_mut().zip(known.as_flattened()).for_each(|(sum, known)| *sum += known);
    eliminate::<0, N>(left, right);
    eliminate::<1, N>(left, right);
    eliminate::<2, N>(left, right);
    eliminate::<3, N>(left, right);
    eliminate::<4, N>(left, right);
    substitute::<5, N>(left, right);
    substitute::<4, N>(left, right);
    substitute::<3, N>(left, right);
    substitute::<2, N>(left, right);
    substitute::<1, N>(left, right);
    substitute::<0, N>(left, right);
}

/// Frees the rows below row `PIVOT` of its unknown (Gauss, on the upper triangle alone). What is known beforehand keeps every
/// pivot above zero, so that none has to be looked for. `PIVOT` is a constant, because loops of fixed length cost the target
/// half as much.
#[inline(always)]
fn eliminate<const PIVOT: usize, const N: usize>(left: &mut [[f32; N]; N], right: &mut [f32; N]) {
    if PIVOT + 1 >= N {
        return;
    }
    let (above, below) = left.split_at_mut(PIVOT + 1);
    let (known, unknown) = right.split_at_mut(PIVOT + 1);
    let (Some(chosen), Some(value)) = (above.last(), known.last()) else { return };
    let inverse = 1.0 / chosen.get(PIVOT).copied().unwrap_or(1.0);
    for (place, (row, right)) in below.iter_mut().zip(unknown).enumerate() {
        let column = PIVOT + 1 + place;
        let factor = inverse * chosen.get(column).copied().unwrap_or(0.0);
        row.iter_mut().zip(chosen).skip(column).for_each(|(x, p)| *x -= factor * p);
        *right -= factor * value;
    }
}

/// The unknown of row `PIVOT` from those behind it.
#[inline(always)]
fn substitute<const PIVOT: usize, const N: usize>(left: &[[f32; N]; N], right: &mut [f32; N]) {
    if PIVOT >= N {
        return;
    }
    let (known, behind) = right.split_at_mut(PIVOT + 1);
    let (Some(row), Some(value)) = (left.get(PIVOT), known.last_mut()) else { return };
    for (coefficient, unknown) in row.split_at(PIVOT + 1).1.iter().zip(behind) {
        *value -= coefficient * *unknown;
    }
    *value /= row.get(PIVOT).copied().unwrap_or(1.0);
}
