//! The minimum of a quadratic function in a box.

use nalgebra::{DMatrix, DVector};

/// Most changes per coordinate of the set that is held on bounds.
const CHANGES: usize = 10;
/// Twice the gain for which a coordinate is let go.
const LEAST_GAIN: f64 = 1e-20;

/// The step x within `low` ≤ x ≤ `high` that is least in ½ xᵀHx − gᵀx, H positive definite; none where it is not. Zero lies
/// within the bounds.
///
/// By the primal active set method (Nocedal & Wright 2006, Numerical Optimization, section 16.5): every step lowers
/// the function, and no set of held coordinates comes back.
pub(super) fn bounded_step(
    curvature: &DMatrix<f64>,
    pull: &DVector<f64>,
    low: &DVector<f64>,
    high: &DVector<f64>,
) -> Option<DVector<f64>> {
    let count = pull.len();
    let mut step = DVector::zeros(count);
    let outward = |p: usize, pull: f64, step: f64| (step <= low[p] && pull < 0.0) || (step >= high[p] && pull > 0.0);
    let mut held: Vec<bool> = (0..count).map(|p| outward(p, pull[p], 0.0)).collect();
    for _ in 0..=CHANGES * count {
        let target = solve(curvature, pull, &step, &held)?;
        let blocked =
            (0..count).filter(|&p| !held[p]).map(|p| (p, share_within(step[p], target[p], (low[p], high[p]))));
        let nearest = blocked.filter(|(_, share)| *share < 1.0).min_by(|one, other| one.1.total_cmp(&other.1));
        if let Some((p, share)) = nearest {
            step += share * (&target - &step);
            step[p] = if target[p] < low[p] { low[p] } else { high[p] };
            held[p] = true;
            continue;
        }
        step = target;
        let rest = pull - curvature * &step;
        let gain = |p: usize| rest[p] * rest[p] / curvature[(p, p)];
        let inward = (0..count).filter(|&p| held[p] && !outward(p, rest[p], step[p]) && gain(p) > LEAST_GAIN);
        let Some(p) = inward.max_by(|&one, &other| gain(one).total_cmp(&gain(other))) else { break };
        held[p] = false;
    }
    Some(DVector::from_fn(count, |p, _| step[p].clamp(low[p], high[p])))
}

/// Share of the way from `from` to `to` that lies within the bounds, 0 to 1.
fn share_within(from: f64, to: f64, (low, high): (f64, f64)) -> f64 {
    let end = to.clamp(low, high);
    if end == to { 1.0 } else { ((end - from) / (to - from)).clamp(0.0, 1.0) }
}

/// The minimum over the free coordinates with the others where they are.
fn solve(curvature: &DMatrix<f64>, pull: &DVector<f64>, step: &DVector<f64>, held: &[bool]) -> Option<DVector<f64>> {
    let mut found = DVector::from_fn(held.len(), |p, _| if held[p] { step[p] } else { 0.0 });
    let free: Vec<usize> = (0..held.len()).filter(|&p| !held[p]).collect();
    if free.is_empty() {
        return Some(found);
    }
    let rest = pull - curvature * &found;
    let matrix = DMatrix::from_fn(free.len(), free.len(), |i, j| curvature[(free[i], free[j])]);
    let right = DVector::from_fn(free.len(), |i, _| rest[free[i]]);
    let values = matrix.cholesky()?.solve(&right);
    for (&p, value) in free.iter().zip(values.iter()) {
        found[p] = *value;
    }
    Some(found)
}
