//! Products of small matrices, the same bits on every machine.
//!
//! Libraries of linear algebra fuse multiplication and addition where the machine can, so that the same seed would train
//! another table elsewhere.

use pulp::{Arch, NullaryFnOnce};

/// A matrix, row by row, or its transpose.
#[derive(Clone, Copy)]
pub struct Operand<'a> {
    numbers: &'a [f32],
    width: usize,
    transposed: bool,
}

impl<'a> Operand<'a> {
    /// Rows of `width` numbers.
    pub fn new(numbers: &'a [f32], width: usize) -> Self {
        Self { numbers, width, transposed: false }
    }

    /// The transpose.
    pub fn transposed(self) -> Self {
        Self { transposed: !self.transposed, ..self }
    }

    fn rows(&self) -> usize {
        if self.transposed { self.width } else { self.numbers.len() / self.width }
    }

    fn columns(&self) -> usize {
        if self.transposed { self.numbers.len() / self.width } else { self.width }
    }

    /// Number by number, row by row.
    fn written_out(&self) -> Vec<f32> {
        if !self.transposed {
            return self.numbers.to_vec();
        }
        (0..self.width).flat_map(|c| self.numbers.iter().skip(c).step_by(self.width).copied()).collect()
    }
}

/// The product, row by row; inner sizes have to be the same.
pub fn product(left: Operand<'_>, right: Operand<'_>) -> Vec<f32> {
    assert_eq!(left.columns(), right.rows(), "inner sizes of a product");
    let (inner, width) = (right.rows(), right.columns());
    let mut sums = vec![0.0; left.rows() * width];
    let (left, right) = (left.written_out(), right.written_out());
    Arch::new().dispatch(Rows { left: &left, right: &right, sums: &mut sums, inner, width });
    sums
}

/// Rows of a product, to be summed with registers as wide as the machine has.
struct Rows<'a> {
    left: &'a [f32],
    right: &'a [f32],
    sums: &'a mut [f32],
    inner: usize,
    width: usize,
}

impl NullaryFnOnce for Rows<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for (sums, left) in self.sums.chunks_exact_mut(self.width).zip(self.left.chunks_exact(self.inner)) {
            let (tiles, rest) = sums.as_chunks_mut::<64>();
            for (place, tile) in tiles.iter_mut().enumerate() {
                add_products(tile, left, self.right, self.width, 64 * place);
            }
            let done = 64 * tiles.len();
            let (tiles, rest) = rest.as_chunks_mut::<16>();
            for (place, tile) in tiles.iter_mut().enumerate() {
                add_products(tile, left, self.right, self.width, done + 16 * place);
            }
            let done = done + 16 * tiles.len();
            for (place, sum) in rest.iter_mut().enumerate() {
                add_products(std::array::from_mut(sum), left, self.right, self.width, done + place);
            }
        }
    }
}

/// Adds to sums that stay in registers the products of a row of the left matrix with columns of the right from `first` on.
#[inline(always)]
fn add_products<const T: usize>(tile: &mut [f32; T], left: &[f32], right: &[f32], width: usize, first: usize) {
    let mut sums = *tile;
    for (x, row) in left.iter().zip(right.chunks_exact(width)) {
        if let Some(row) = row.get(first..).and_then(<[f32]>::first_chunk::<T>) {
            sums.iter_mut().zip(row).for_each(|(sum, y)| *sum += x * y);
        }
    }
    *tile = sums;
}

#[cfg(test)]
mod tests {
    use super::{Operand, product};

    #[test]
    fn products_are_those_written_out() {
        for (rows, inner, columns) in [(1, 1, 1), (3, 2, 5), (17, 33, 16), (5, 61, 64), (40, 7, 100)] {
            let a: Vec<f32> = (0..rows * inner).map(|k| (k as f32 * 0.37).sin()).collect();
            let b: Vec<f32> = (0..inner * columns).map(|k| (k as f32 * 0.71).cos()).collect();
            let straight = product(Operand::new(&a, inner), Operand::new(&b, columns));
            for row in 0..rows {
                for column in 0..columns {
                    let sum: f32 = (0..inner).map(|k| a[row * inner + k] * b[k * columns + column]).sum();
                    assert!((straight[row * columns + column] - sum).abs() < 1e-4, "{rows} {inner} {columns}");
                }
            }
            let a_turned = Operand::new(&a, inner).transposed().written_out();
            let b_turned = Operand::new(&b, columns).transposed().written_out();
            let turned = (Operand::new(&a_turned, rows).transposed(), Operand::new(&b_turned, inner).transposed());
            assert_eq!(product(turned.0, turned.1), straight);
        }
    }
}
