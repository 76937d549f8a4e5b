//! The way to the mode (Levenberg 1944, Quart. Appl. Math. 2:164; Marquardt 1963, SIAM J. Appl. Math. 11:431).

use super::normal_equations::NormalEquations;
use super::problem::Problem;
use super::state::{Scales, State};
use super::variances::{SETTLED, are_estimated, first_scales, reestimate};

const FIRST_DAMPING: f64 = 1e-3;
const LEAST_DAMPING: f64 = 1e-9;
/// Damping at which no step lowers the objective any more.
const STUCK: f64 = 1e9;
/// Damping above which a small gain says nothing of the minimum: the step was short.
const SHORT_STEP: f64 = 1.0;
/// Rounds of descending and estimating variances in turn.
const ROUNDS: usize = 15;
/// Gain at which the first round ends when variances are yet to be estimated.
const FIRST_TOLERANCE: f64 = 1e-2;

/// Where a fit ended.
pub(super) struct Optimum {
    pub state: State,
    pub scales: Scales,
    /// What was minimised.
    pub objective: f64,
    /// Trial steps.
    pub iterations: usize,
    pub converged: bool,
}

/// From a state to the mode, variances estimated along the way where that is asked for.
pub(super) fn optimise(problem: &Problem<'_>, start: State) -> Optimum {
    let mut scales = first_scales(problem);
    let estimated = are_estimated(problem);
    let mut search =
        Search { objective: start.objective(problem, &scales), state: start, damping: FIRST_DAMPING, iterations: 0 };
    let mut converged = false;
    for round in 0..ROUNDS {
        let rough = estimated && round == 0;
        let tolerance = if rough { problem.options.tolerance.max(FIRST_TOLERANCE) } else { problem.options.tolerance };
        let settled = search.descend(problem, &scales, tolerance);
        if !estimated {
            converged = settled;
            break;
        }
        let (next, slope) = reestimate(problem, &search.state, &scales);
        if slope < SETTLED && !rough {
            converged = settled;
            break;
        }
        if search.iterations >= problem.options.most_iterations {
            break;
        }
        scales = next;
        search.objective = search.state.objective(problem, &scales);
    }
    Optimum { state: search.state, scales, objective: search.objective, iterations: search.iterations, converged }
}

struct Search {
    state: State,
    objective: f64,
    damping: f64,
    iterations: usize,
}

impl Search {
    /// Steps until one gains less than `tolerance`; whether that came about.
    fn descend(&mut self, problem: &Problem<'_>, scales: &Scales, tolerance: f64) -> bool {
        while self.iterations < problem.options.most_iterations && self.damping < STUCK {
            self.iterations += 1;
            let Some((state, objective)) = self.attempt(problem, scales) else {
                self.damping *= 6.0;
                continue;
            };
            let gain = self.objective - objective;
            let settled = gain.abs() < tolerance && self.damping < SHORT_STEP;
            if gain > 0.0 {
                self.state = state;
                self.objective = objective;
                self.damping = (self.damping * 0.1).max(LEAST_DAMPING);
            } else {
                self.damping *= 6.0;
            }
            if settled {
                return true;
            }
        }
        self.damping = self.damping.min(SHORT_STEP);
        false
    }

    fn attempt(&self, problem: &Problem<'_>, scales: &Scales) -> Option<(State, f64)> {
        let equations = NormalEquations::new(problem, &self.state, scales, self.damping);
        let step = equations.step(problem, &self.state, self.damping)?;
        let state = self.state.after(problem, &step)?;
        let objective = state.objective(problem, scales);
        objective.is_finite().then_some((state, objective))
    }
}
