//! Least squares in two unknowns: a line.

use crate::scalar::Scalar;

use super::{Bounds, Triangle};

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
