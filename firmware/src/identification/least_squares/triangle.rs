//! The triangular root of a least-squares problem, into which rows go one by one.

use crate::scalar::Scalar;

use super::rotation::take_in;

/// The triangular root of a linear least-squares problem in N unknowns: R and q with ‖Rx − q‖² + `rest` the sum of squared
/// residuals at x, for all rows so far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::identification) struct Triangle<S, const N: usize> {
    /// R, row by row; zero below the diagonal.
    pub root: [[S; N]; N],
    /// q.
    pub right: [S; N],
    /// The sum of squared residuals at the best x.
    pub rest: S,
}

impl<S: Scalar, const N: usize> Triangle<S, N> {
    /// No rows: nothing is known of x.
    pub fn new() -> Self {
        Self { root: [[S::zero(); N]; N], right: [S::zero(); N], rest: S::zero() }
    }

    /// Adds the equation `row` · x = `value` by Givens' rotations.
    pub fn add(&mut self, mut row: [S; N], mut value: S) {
        take_in(&mut self.root, &mut self.right, &mut row, &mut value);
        self.rest += value * value;
    }

    /// Adds the equation `factor` · xᵢ = `value` of one unknown alone.
    pub fn add_alone(&mut self, place: usize, factor: S, value: S) {
        self.add(core::array::from_fn(|column| if column == place { factor } else { S::zero() }), value);
    }

    /// The same equations without the columns of some unknowns, which are held to zero instead.
    pub fn held(&self, held: &[bool; N]) -> Self {
        let mut kept = Self::new();
        for (place, _) in held.iter().enumerate().filter(|(_, held)| **held) {
            kept.add_alone(place, S::one(), S::zero());
        }
        kept.add_all_but(self, held);
        kept
    }

    /// Adds the equations of another triangle without the columns of some unknowns.
    pub fn add_all_but(&mut self, other: &Self, held: &[bool; N]) {
        for (row, value) in other.root.iter().zip(other.right) {
            let mut row = *row;
            for (entry, _) in row.iter_mut().zip(held).filter(|(_, held)| **held) {
                *entry = S::zero();
            }
            self.add(row, value);
        }
    }

    /// Lets every row so far count for `share` (0 … 1) of what it did.
    pub fn forget(&mut self, share: S) {
        let root = share.sqrt();
        self.root.iter_mut().flatten().for_each(|entry| *entry = root * *entry);
        self.right.iter_mut().for_each(|entry| *entry = root * *entry);
        self.rest = share * self.rest;
    }

    /// The diagonal entry of R at a place: the length of what that column has beyond those before it.
    pub fn pivot(&self, place: usize) -> S {
        self.root.get(place).and_then(|row| row.get(place)).map_or(S::zero(), |pivot| pivot.abs())
    }

    /// The length of a column.
    pub fn length(&self, place: usize) -> S {
        let squares = self.root.iter().filter_map(|row| row.get(place)).map(|entry| *entry * *entry);
        squares.fold(S::zero(), |sum, square| sum + square).sqrt()
    }

    /// The sum of squared residuals at x = 0.
    pub fn cost_at_zero(&self) -> S {
        self.right.iter().fold(self.rest, |sum, entry| sum + *entry * *entry)
    }

    /// Half the downhill slope of the sum of squares along an unknown, at x = 0.
    pub fn descent(&self, place: usize) -> S {
        let products = self.root.iter().zip(&self.right).filter_map(|(row, right)| Some(*row.get(place)? * *right));
        products.fold(S::zero(), |sum, product| sum + product)
    }

    /// Makes the equations not depend on an unknown.
    pub fn drop_column(&mut self, place: usize) {
        self.root.iter_mut().filter_map(|row| row.get_mut(place)).for_each(|entry| *entry = S::zero());
    }

    /// The best x beside √damping ℓ x = 0, ℓ being the length of the longest column, where the unknowns that are not `free` are zero (Levenberg
    /// 1944); none as for [`Self::solution`].
    pub fn damped_solution(&self, damping: S, free: &[bool; N]) -> Option<[S; N]> {
        let longest = (0..N).map(|place| self.length(place)).fold(S::zero(), Scalar::max);
        let weight = damping.sqrt() * longest;
        let mut damped = *self;
        for (place, _) in free.iter().enumerate().filter(|(_, free)| !**free) {
            damped.drop_column(place);
        }
        for place in 0..N {
            damped.add_alone(place, weight, S::zero());
        }
        damped.solution()
    }

    /// The best x; none where a column is a combination of those before it, to the last digits.
    pub fn solution(&self) -> Option<[S; N]> {
        self.back(&self.right)
    }

    /// (RᵀR)⁻¹ v; none as for [`Self::solution`].
    pub fn normal_solve(&self, mut v: [S; N]) -> Option<[S; N]> {
        for place in 0..N {
            let row = self.root.get(place)?;
            let solved = *v.get(place)? / self.sound_pivot(place)?;
            for (entry, known) in v.iter_mut().zip(row).skip(place + 1) {
                *entry -= *known * solved;
            }
            *v.get_mut(place)? = solved;
        }
        self.back(&v)
    }

    /// The variances of x, over that of a row's noise; none as for [`Self::solution`].
    pub fn variances(&self) -> Option<[S; N]> {
        (0..N).all(|place| self.sound_pivot(place).is_some()).then(|| self.told_variances())
    }

    /// The best x; zero in the unknowns that no row tells.
    pub fn told_solution(&self) -> [S; N] {
        let mut x = [S::zero(); N];
        for (place, (row, right)) in self.root.iter().zip(&self.right).enumerate().rev() {
            let mut sum = *right;
            for (entry, known) in row.iter().zip(&x).skip(place + 1) {
                sum -= *entry * *known;
            }
            let pivot = self.pivot(place);
            if let (Some(slot), true) = (x.get_mut(place), pivot > S::zero()) {
                *slot = sum / pivot;
            }
        }
        x
    }

    /// [`Self::variances`]; zero in the unknowns that no row tells.
    pub fn told_variances(&self) -> [S; N] {
        core::array::from_fn(|place| {
            let row = self.inverse_row(place);
            product(&row, &row)
        })
    }

    /// A column of (RᵀR)⁻¹: products of the rows of R⁻¹.
    pub fn covariances(&self, place: usize) -> [S; N] {
        let own = self.inverse_row(place);
        core::array::from_fn(|other| product(&own, &self.inverse_row(other)))
    }

    /// A row of R⁻¹: y with yᵀ R = eᵀ.
    fn inverse_row(&self, place: usize) -> [S; N] {
        let mut y = [S::zero(); N];
        for column in place..N {
            let mut sum = if column == place { S::one() } else { S::zero() };
            for (known, row) in y.iter().zip(&self.root).take(column).skip(place) {
                sum -= *known * row.get(column).copied().unwrap_or(S::zero());
            }
            let pivot = self.pivot(column);
            if let (Some(slot), true) = (y.get_mut(column), pivot > S::zero()) {
                *slot = sum / pivot;
            }
        }
        y
    }

    /// ln |det R| over the unknowns that some row tells.
    pub fn ln_determinant(&self) -> S {
        let mut sum = S::zero();
        for place in 0..N {
            let pivot = self.pivot(place);
            if pivot > S::zero() {
                sum += pivot.ln();
            }
        }
        sum
    }

    /// R⁻¹ v.
    fn back(&self, v: &[S; N]) -> Option<[S; N]> {
        let mut x = *v;
        for place in (0..N).rev() {
            let row = self.root.get(place)?;
            let known = row.iter().zip(&x).skip(place + 1);
            let sum = known.fold(S::zero(), |sum, (entry, solved)| sum + *entry * *solved);
            let entry = x.get_mut(place)?;
            *entry = (*entry - sum) / self.sound_pivot(place)?;
        }
        Some(x)
    }

    /// The pivot with its sign, where rounding has left anything of it.
    fn sound_pivot(&self, place: usize) -> Option<S> {
        let pivot = *self.root.get(place)?.get(place)?;
        let rounding = S::constant(8.0 * S::EPSILON) * self.length(place);
        (pivot.abs() > rounding && pivot.is_finite()).then_some(pivot)
    }
}

fn product<S: Scalar>(a: &[S], b: &[S]) -> S {
    let mut sum = S::zero();
    for (x, y) in a.iter().zip(b) {
        sum += *x * *y;
    }
    sum
}
