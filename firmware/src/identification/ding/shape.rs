//! Step 1: where the stresses peak and end, from the drawbar pull.

use crate::identification::StressShape;
use crate::identification::least_squares::{Bounds, Triangle};
use crate::scalar::Scalar;

use super::DingBounds;
use super::rows::Rows;

/// Where the search starts.
const START: [f64; 3] = [0.3, 0.2, -0.05];

/// Least squares of DP over c₁, c₂ and c₃ within their bounds, by Levenberg's and Marquardt's steps. A parameter at a
/// bound stays there while the residuals fall outward. Along a flat valley the steps may end before they have settled: the
/// place is then the best so far, within rounding. None where a number overflows.
pub(super) fn fit<S: Scalar>(rows: &Rows<'_, S>, bounds: &DingBounds<S>) -> Option<StressShape<S>> {
    const STEPS: usize = 60;
    let bounds = [bounds.c1, bounds.c2, bounds.c3];
    let mut best = Place::new(rows, held(START.map(S::constant), &bounds));
    let mut damping = S::constant(1e-3);
    // Of the drawbar pulls: they are differences of forces of the size of the load.
    let rounding = S::constant(8.0 * S::EPSILON) * rows.load_n();
    for _ in 0..STEPS {
        let next = Place::new(rows, best.step(damping, &bounds)?);
        let settled = next.is_near(&best.at);
        // What rounding adds does not count: along the valley of c₁ and c₃ the sum of squares is flat to the last digits of
        // single precision while the step still knows the way.
        if next.cost <= best.cost + rounding * best.cost.sqrt() {
            best = next;
            damping = (S::constant(0.3) * damping).max(S::constant(1e-9));
        } else {
            damping = S::constant(3.0) * damping;
        }
        if settled {
            break;
        }
    }
    let [c1, c2, c3] = best.at;
    best.cost.is_finite().then_some(StressShape { c1, c2, c3 })
}

fn held<S: Scalar>(mut at: [S; 3], bounds: &[Bounds<S>; 3]) -> [S; 3] {
    at.iter_mut().zip(bounds).for_each(|(value, bounds)| *value = bounds.hold(*value));
    at
}

/// A place of the search, with the equations for the step from there.
struct Place<S> {
    at: [S; 3],
    step: Triangle<S, 3>,
    cost: S,
}

impl<S: Scalar> Place<S> {
    fn new(rows: &Rows<'_, S>, at: [S; 3]) -> Self {
        let mut step = Triangle::new();
        let mut cost = S::zero();
        for left in rows.pull_left(at) {
            step.add(left.slopes.map(|slope| -slope), left.value);
            cost += left.value * left.value;
        }
        Self { at, step, cost }
    }

    /// Whether it is nearly another place.
    fn is_near(&self, other: &[S; 3]) -> bool {
        let nearest = S::constant(64.0 * S::EPSILON).max(S::constant(1e-8));
        self.at.iter().zip(other).all(|(here, there)| (*here - *there).abs() <= nearest)
    }

    /// Where the damped step leads.
    fn step(&self, damping: S, bounds: &[Bounds<S>; 3]) -> Option<[S; 3]> {
        let mut free = [true; 3];
        for (place, ((free, value), bounds)) in free.iter_mut().zip(&self.at).zip(bounds).enumerate() {
            let outward = self.step.descent(place);
            *free = !(*value <= bounds.low && outward <= S::zero() || *value >= bounds.high && outward >= S::zero());
        }
        let mut next = self.step.damped_solution(damping, &free)?;
        next.iter_mut().zip(&self.at).for_each(|(step, value)| *step += *value);
        Some(held(next, bounds))
    }
}
