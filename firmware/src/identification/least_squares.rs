//! Least squares by rotations, row by row: no matrix is stored and no product of columns is formed, so that single
//! precision keeps the digits that normal equations lose.

use crate::scalar::Scalar;

/// The triangular root of a linear least-squares problem in N unknowns: R and q with ‖Rx − q‖² + `rest` the sum of squared
/// residuals at x, for all rows so far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Triangle<S, const N: usize> {
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
        for (place, (known, right)) in self.root.iter_mut().zip(&mut self.right).enumerate() {
            let (Some(&pivot), Some(&entry)) = (known.get(place), row.get(place)) else { continue };
            let length = (pivot * pivot + entry * entry).sqrt();
            if length > S::zero() {
                let (cos, sin) = (pivot / length, entry / length);
                for (above, below) in known.iter_mut().zip(&mut row) {
                    (*above, *below) = (cos * *above + sin * *below, cos * *below - sin * *above);
                }
                (*right, value) = (cos * *right + sin * value, cos * value - sin * *right);
            }
        }
        self.rest += value * value;
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
        let mut variances = [S::zero(); N];
        for (place, variance) in variances.iter_mut().enumerate() {
            let mut unit = [S::zero(); N];
            *unit.get_mut(place)? = S::one();
            *variance = *self.normal_solve(unit)?.get(place)?;
        }
        Some(variances)
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

impl<S: Scalar> Triangle<S, 2> {
    /// Greatest over least singular value with both columns brought to the same length: so it has no units, and depends on
    /// nothing but the angle between the columns. Infinite where they are parallel.
    pub fn condition_number(&self) -> S {
        let length = self.length(1);
        let [[_, along], _] = self.root;
        (S::one() + along.abs() / length) * length / self.pivot(1)
    }

    /// The sum of squared residuals at x.
    pub fn cost(&self, [x, y]: [S; 2]) -> S {
        let [[a, b], [_, d]] = self.root;
        let [p, q] = self.right;
        let (first, second) = (a * x + b * y - p, d * y - q);
        first * first + second * second + self.rest
    }

    /// The best x within bounds. Where the best of all lies outside, it is on an edge: the best of each is tried.
    pub fn solution_within(&self, [xs, ys]: [Bounds<S>; 2]) -> [S; 2] {
        if let Some([x, y]) = self.solution()
            && xs.hold(x) == x
            && ys.hold(y) == y
        {
            return [x, y];
        }
        let [[a, b], [_, d]] = self.root;
        let [p, q] = self.right;
        let ratio = |above: S, below: S| if below > S::zero() { above / below } else { S::zero() };
        let x_at = |y: S| [xs.hold(ratio(a * (p - b * y), a * a)), y];
        let y_at = |x: S| [x, ys.hold(ratio(b * (p - a * x) + d * q, b * b + d * d))];
        let edges = [y_at(xs.low), y_at(xs.high), x_at(ys.low), x_at(ys.high)];
        let best = edges.into_iter().filter(|[x, y]| x.is_finite() && y.is_finite());
        let start = [xs.hold(S::zero()), ys.hold(S::zero())];
        best.fold(start, |best, edge| if self.cost(edge) < self.cost(best) { edge } else { best })
    }
}

/// The least and the greatest value that a parameter may take; infinite where there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds<S> {
    /// The least.
    pub low: S,
    /// The greatest.
    pub high: S,
}

impl<S: Scalar> Bounds<S> {
    /// From `low` to `high`.
    pub fn new(low: f64, high: f64) -> Self {
        Self { low: S::constant(low), high: S::constant(high) }
    }

    /// Any number.
    pub fn none() -> Self {
        Self::new(f64::NEG_INFINITY, f64::INFINITY)
    }

    /// The nearest value within.
    pub(super) fn hold(&self, value: S) -> S {
        value.max(self.low).min(self.high)
    }

    /// Whether a value lies within and not at an end.
    pub(super) fn contains_inside(&self, value: S) -> bool {
        value > self.low && value < self.high
    }
}
