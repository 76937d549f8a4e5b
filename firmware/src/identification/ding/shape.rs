//! Step 1: where the stresses peak and end, from the drawbar pull.

use crate::identification::StressShape;
use crate::identification::least_squares::{Bounds, Triangle};
use crate::scalar::Scalar;

use super::DingBounds;
use super::rows::Rows;

/// Where the search starts.
const START: [f64; 3] = [0.3, 0.2, -0.05];

/// Least squares of DP over c₁, c₂ and c₃ within their bounds, by Levenberg's and Marquardt's steps. A parameter at a
/// bound stays there while the residuals fall outward. None where a number overflows.
pub(super) fn fit<S: Scalar>(rows: &Rows<'_, S>, bounds: &DingBounds<S>) -> Option<StressShape<S>> {
    const STEPS: usize = 60;
    let bounds = [bounds.c1, bounds.c2, bounds.c3];
    let mut best = Place::new(rows, held(START.map(S::constant), &bounds));
    let mut damping = S::constant(1e-3);
    for _ in 0..STEPS {
        let next = Place::new(rows, best.step(damping, &bounds)?);
        if next.at == best.at {
            break;
        }
        if next.cost < best.cost {
            let settled = best.cost - next.cost <= S::constant(16.0 * S::EPSILON) * best.cost;
            best = next;
            damping = (S::constant(0.1) * damping).max(S::constant(1e-6));
            if settled {
                break;
            }
        } else {
            damping = S::constant(10.0) * damping;
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

    /// Where the damped step leads.
    fn step(&self, damping: S, bounds: &[Bounds<S>; 3]) -> Option<[S; 3]> {
        let mut equations = self.step;
        let longest = (0..3).map(|place| self.step.length(place)).fold(S::zero(), Scalar::max);
        let weight = damping.sqrt() * longest;
        for (place, (value, bounds)) in self.at.iter().zip(bounds).enumerate() {
            let outward = self.step.descent(place);
            if (*value <= bounds.low && outward <= S::zero()) || (*value >= bounds.high && outward >= S::zero()) {
                equations.drop_column(place);
            }
        }
        for place in 0..3 {
            let mut row = [S::zero(); 3];
            row.iter_mut().skip(place).take(1).for_each(|entry| *entry = weight);
            equations.add(row, S::zero());
        }
        let mut next = equations.solution()?;
        next.iter_mut().zip(&self.at).for_each(|(step, value)| *step += *value);
        Some(held(next, bounds))
    }
}
