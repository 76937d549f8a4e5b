//! Linear equations in three unknowns, more of them than unknowns, by their triangular root.

use crate::scalar::Scalar;

/// The least-squares equations J x = e as R x = u with RᵀR = JᵀJ: half the digits that the normal equations would take.
#[derive(Debug, Clone, Copy)]
pub(super) struct Equations<S> {
    /// R, row by row; zero below its diagonal.
    root: [[S; 3]; 3],
    /// u.
    right: [S; 3],
    /// The sum of the squares that no x takes away.
    rest: S,
}

/// The ends of a range of singular values.
#[derive(Debug, Clone, Copy)]
pub(super) struct SingularValues<S> {
    /// The greatest.
    pub greatest: S,
    /// The least.
    pub least: S,
}

impl<S: Scalar> Equations<S> {
    /// No equation yet.
    pub fn none() -> Self {
        Self { root: [[S::zero(); 3]; 3], right: [S::zero(); 3], rest: S::zero() }
    }

    /// Takes in an equation, by Givens' rotations.
    pub fn add(&mut self, row: [S; 3], value: S) {
        let (mut row, mut value) = (row, value);
        for (place, (held, right)) in self.root.iter_mut().zip(&mut self.right).enumerate() {
            let (Some(&pivot), Some(&entry)) = (held.get(place), row.get(place)) else { break };
            let norm = (pivot * pivot + entry * entry).sqrt();
            if norm > S::zero() {
                let (cos, sin) = (pivot / norm, entry / norm);
                let turn = |a: &mut S, b: &mut S| (*a, *b) = (cos * *a + sin * *b, cos * *b - sin * *a);
                held.iter_mut().zip(&mut row).for_each(|(a, b)| turn(a, b));
                turn(right, &mut value);
            }
        }
        self.rest += value * value;
    }

    /// The sum of squares at x = 0.
    pub fn cost(&self) -> S {
        self.right.iter().fold(self.rest, |sum, &entry| sum + entry * entry)
    }

    /// Jᵀe: the way down.
    pub fn descent(&self) -> [S; 3] {
        let mut sum = [S::zero(); 3];
        for (row, &right) in self.root.iter().zip(&self.right) {
            sum.iter_mut().zip(row).for_each(|(sum, &entry)| *sum += entry * right);
        }
        sum
    }

    /// The same with √`damping` x = 0 beside it, and only the `free` unknowns.
    pub fn damped(&self, damping: S, free: [bool; 3]) -> Self {
        let mut damped = Self::none();
        damped.root = diagonal(damping.sqrt());
        for (row, &right) in self.root.iter().zip(&self.right) {
            let mut row = *row;
            row.iter_mut().zip(free).filter(|(_, free)| !free).for_each(|(entry, _)| *entry = S::zero());
            damped.add(row, right);
        }
        damped
    }

    /// The x of least squares; not finite where the equations leave it open.
    pub fn solve(&self) -> [S; 3] {
        let [[a, b, c], [_, d, e], [_, _, f]] = self.root;
        let [u, v, w] = self.right;
        let z = w / f;
        let y = (v - e * z) / d;
        [(u - b * y - c * z) / a, y, z]
    }

    /// The greatest length of a column of J.
    pub fn greatest_column(&self) -> S {
        columns(&self.root).iter().map(|column| dot(column, column).sqrt()).fold(S::zero(), Scalar::max)
    }

    /// The roots of the diagonal of (JᵀJ)⁻¹.
    pub fn stds(&self) -> [S; 3] {
        let [[a, b, c], [_, d, e], [_, _, f]] = self.root;
        let rows = [
            [S::one() / a, -(b / (a * d)), (b * e / d - c) / (a * f)],
            [S::zero(), S::one() / d, -(e / (d * f))],
            [S::zero(), S::zero(), S::one() / f],
        ];
        rows.map(|row| dot(&row, &row).sqrt())
    }

    /// The root of the mean square that the solution leaves of `count` equations, and at least 1.
    pub fn residual_std(&self, count: usize) -> S {
        let spare = S::constant(count.saturating_sub(3).max(1) as f64);
        (self.rest / spare).sqrt().max(S::one())
    }

    /// The greatest and the least singular value of J, by Hestenes' one-sided rotations.
    pub fn singular_values(&self) -> SingularValues<S> {
        const SWEEPS: usize = 12;
        let mut columns = columns(&self.root);
        for _ in 0..SWEEPS {
            let [p, q, r] = &mut columns;
            orthogonalise(p, q);
            orthogonalise(p, r);
            orthogonalise(q, r);
        }
        let [p, q, r] = columns.map(|column| dot(&column, &column).sqrt());
        SingularValues { greatest: p.max(q).max(r), least: p.min(q).min(r) }
    }
}

impl<S: Scalar> SingularValues<S> {
    /// The greatest over the least.
    pub fn ratio(&self) -> S {
        self.greatest / self.least
    }
}

fn diagonal<S: Scalar>(entry: S) -> [[S; 3]; 3] {
    let zero = S::zero();
    [[entry, zero, zero], [zero, entry, zero], [zero, zero, entry]]
}

fn columns<S: Scalar>(root: &[[S; 3]; 3]) -> [[S; 3]; 3] {
    let [[a, b, c], [_, d, e], [_, _, f]] = *root;
    [[a, S::zero(), S::zero()], [b, d, S::zero()], [c, e, f]]
}

fn dot<S: Scalar>(one: &[S; 3], other: &[S; 3]) -> S {
    one.iter().zip(other).fold(S::zero(), |sum, (&a, &b)| sum + a * b)
}

/// Turns two columns in their plane until they are square to each other.
fn orthogonalise<S: Scalar>(one: &mut [S; 3], other: &mut [S; 3]) {
    let (first, second, product) = (dot(one, one), dot(other, other), dot(one, other));
    if product.abs() <= S::constant(S::EPSILON) * (first * second).sqrt() {
        return;
    }
    let cotangent = (second - first) / (product + product);
    let size = S::one() / (cotangent.abs() + (S::one() + cotangent * cotangent).sqrt());
    let tangent = if cotangent < S::zero() { -size } else { size };
    let cos = S::one() / (S::one() + tangent * tangent).sqrt();
    let sin = cos * tangent;
    for (a, b) in one.iter_mut().zip(other) {
        (*a, *b) = (cos * *a - sin * *b, sin * *a + cos * *b);
    }
}
