//! Levenberg–Marquardt: K. Levenberg 1944, D. W. Marquardt 1963, with bounds by projection.

use crate::scalar::Scalar;

use super::problem::{Fit, Held, Problem, State};

/// How long a descent goes on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Patience<S> {
    /// Most steps.
    pub steps: u16,
    /// Where a step promises to lower the cost by less, the descent has settled.
    pub gain: S,
    /// Damping of the first step, as a share of each column's length.
    pub damping: S,
}

/// Where a descent ended.
#[derive(Debug, Clone)]
pub(super) struct Descent<S, const N: usize> {
    pub fit: Fit<S, N>,
    /// Steps tried.
    pub steps: u16,
    /// Whether it ended for want of descent, and not of patience.
    pub settled: bool,
}

/// Descends from a state; none where the equations do not hold there.
pub(super) fn descend<S: Scalar, const N: usize>(
    problem: &Problem<'_, S>,
    start: State<S, N>,
    held: &Held,
    patience: &Patience<S>,
) -> Option<Descent<S, N>> {
    // Damping beyond which a step is no step.
    let stuck = S::constant(1e3);
    let (shrink, grow) = (S::constant(0.3), S::constant(3.0));
    let mut fit = problem.evaluate(start)?;
    let mut damping = patience.damping;
    let mut steps = 0;
    let mut settled = false;
    while steps < patience.steps {
        let step = fit.step(problem, held, damping);
        // A short step promises little wherever it starts.
        settled = step.gain < patience.gain && damping < S::constant(0.3);
        if settled {
            break;
        }
        steps += 1;
        match problem.evaluate(problem.moved(&fit.state, &step)) {
            Some(next) if next.cost <= fit.cost => {
                fit = next;
                damping = damping * shrink;
            }
            _ if damping > stuck => break,
            _ => damping = (damping * grow).max(S::constant(1e-2)),
        }
    }
    Some(Descent { fit, steps, settled })
}
