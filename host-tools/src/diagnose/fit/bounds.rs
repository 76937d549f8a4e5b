//! The minimum of a quadratic function in a box.

use nalgebra::{DMatrix, DVector};

/// Most changes of the set of coordinates that are held on a bound.
const MOST_CHANGES: usize = 40;

/// Where a coordinate of a step is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Held {
    Free,
    Low,
    High,
}

/// The step x within `low` ≤ x ≤ `high` that is least in ½ xᵀHx − gᵀx, H positive definite; none where it is not.
///
/// By the primal–dual active set method (Hintermüller, Ito & Kunisch 2002, SIAM J. Optim. 13:865). If the set of held coordinates goes in circles the
/// last step is cut to the box.
pub(super) fn bounded_step(
    curvature: &DMatrix<f64>,
    pull: &DVector<f64>,
    low: &DVector<f64>,
    high: &DVector<f64>,
) -> Option<DVector<f64>> {
    let count = pull.len();
    let mut held = vec![Held::Free; count];
    let mut step = DVector::zeros(count);
    for _ in 0..MOST_CHANGES {
        step = solve(curvature, pull, low, high, &held)?;
        // What still pulls at a coordinate that is held.
        let rest = pull - curvature * &step;
        let next: Vec<Held> = (0..count).map(|p| hold(held[p], step[p], rest[p], (low[p], high[p]))).collect();
        if next == held {
            break;
        }
        held = next;
    }
    Some(DVector::from_fn(count, |p, _| step[p].clamp(low[p], high[p])))
}

fn hold(held: Held, step: f64, rest: f64, (low, high): (f64, f64)) -> Held {
    match held {
        Held::Free if step < low => Held::Low,
        Held::Free if step > high => Held::High,
        Held::Low if rest < 0.0 => Held::Low,
        Held::High if rest > 0.0 => Held::High,
        _ => Held::Free,
    }
}

/// The minimum over the free coordinates with the others on their bounds.
fn solve(
    curvature: &DMatrix<f64>,
    pull: &DVector<f64>,
    low: &DVector<f64>,
    high: &DVector<f64>,
    held: &[Held],
) -> Option<DVector<f64>> {
    let mut step = DVector::from_fn(held.len(), |p, _| match held[p] {
        Held::Free => 0.0,
        Held::Low => low[p],
        Held::High => high[p],
    });
    let free: Vec<usize> = (0..held.len()).filter(|&p| held[p] == Held::Free).collect();
    if free.is_empty() {
        return Some(step);
    }
    let rest = pull - curvature * &step;
    let matrix = DMatrix::from_fn(free.len(), free.len(), |i, j| curvature[(free[i], free[j])]);
    let right = DVector::from_fn(free.len(), |i, _| rest[free[i]]);
    let found = matrix.cholesky()?.solve(&right);
    for (&p, value) in free.iter().zip(found.iter()) {
        step[p] = *value;
    }
    Some(step)
}
