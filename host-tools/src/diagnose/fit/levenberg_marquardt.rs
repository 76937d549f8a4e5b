//! The way to the mode (Levenberg 1944, Quart. Appl. Math. 2:164; Marquardt 1963, SIAM J. Appl. Math. 11:431).

use super::bend::Bend;
use super::curvature::Curvature;
use super::normal_equations::NormalEquations;
use super::problem::Problem;
use super::state::{Scales, State, Tried};
use super::tempering::Temper;
use super::unseen::UnseenRun;
use super::variances::{SETTLED, are_estimated, first_scales, reestimate};

const FIRST_DAMPING: f64 = 1e-3;
const LEAST_DAMPING: f64 = 1e-9;
/// Factors on the damping after a step that was taken and after one that was not.
const DAMPING_FALL: f64 = 0.1;
const DAMPING_RISE: f64 = 3.0;
/// Share of the damping of the last step that was taken, at or above which one is tried after another failed, and the least.
const DAMPING_NEAR: f64 = 0.3;
const LEAST_FLOOR: f64 = 1e-7;
/// Damping at which no step lowers the objective any more.
const STUCK: f64 = 1e9;
/// Damping above which a small gain says nothing of the minimum: the step was short.
const SHORT_STEP: f64 = 1.0;
/// Rounds of descending and estimating variances in turn.
const ROUNDS: usize = 15;
/// Gain at which the first round ends when variances are yet to be estimated.
const FIRST_TOLERANCE: f64 = 10.0;
/// Steps after which it ends at the latest: with wrong variances the way leads elsewhere.
const FIRST_STEPS: usize = 5;
/// Rounds with more noise than there is, and steps of each, at most; all of them half of the steps of a fit.
const TEMPERED_ROUNDS: usize = 4;
const TEMPERED_STEPS: usize = 6;
/// Gain at which one ends.
const TEMPERED_TOLERANCE: f64 = 1.0;

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
    let mut search = Search {
        objective: start.objective(problem, &scales),
        watched: problem.unseen.iter().filter(|run| run.is_predicted(problem, &start.parameters)).collect(),
        state: start,
        damping: FIRST_DAMPING,
        curvature: Curvature::default(),
        floor: FIRST_DAMPING,
        bend: None,
        failed: false,
        iterations: 0,
    };
    search.temper(problem, &scales);
    let most = search.iterations + problem.options.most_iterations;
    let mut converged = false;
    for round in 0..ROUNDS {
        let rough = estimated && round == 0;
        let tolerance = if rough { problem.options.tolerance.max(FIRST_TOLERANCE) } else { problem.options.tolerance };
        let until = if rough { most.min(search.iterations + FIRST_STEPS) } else { most };
        let settled = search.descend(problem, &scales, tolerance, until);
        if !estimated {
            converged = settled;
            break;
        }
        let (next, slope) = reestimate(problem, &search.state, &scales);
        if slope < SETTLED && !rough {
            converged = settled;
            break;
        }
        if search.iterations >= most {
            break;
        }
        scales = next;
        search.judge_by(problem, &scales);
    }
    Optimum { state: search.state, scales, objective: search.objective, iterations: search.iterations, converged }
}

struct Search<'a> {
    state: State,
    /// Runs that are not seen, and that the model is to go on predicting as it did at the start.
    watched: Vec<&'a UnseenRun>,
    objective: f64,
    damping: f64,
    curvature: Curvature,
    /// Damping from which a step that failed is tried again.
    floor: f64,
    /// What the last step showed, if it failed.
    bend: Option<Bend>,
    /// Whether the last step failed.
    failed: bool,
    iterations: usize,
}

impl Search<'_> {
    /// From far away to where most readings are within reach of the model.
    fn temper(&mut self, problem: &Problem<'_>, scales: &Scales) {
        let mut temper = Temper::of(problem, &self.state, scales);
        if !temper.is_needed() {
            return;
        }
        for _ in 0..TEMPERED_ROUNDS {
            let warm = temper.apply(scales);
            self.begin(problem, &warm);
            let most = (problem.options.most_iterations / 2).min(self.iterations + TEMPERED_STEPS);
            self.descend(problem, &warm, TEMPERED_TOLERANCE, most);
            temper = temper.falling_to(Temper::of(problem, &self.state, scales));
            if !temper.is_needed() {
                break;
            }
        }
        self.begin(problem, scales);
    }

    /// From the same place on other terms: what was learned of the way there holds no more.
    fn begin(&mut self, problem: &Problem<'_>, scales: &Scales) {
        self.curvature = Curvature::default();
        self.damping = FIRST_DAMPING;
        self.floor = FIRST_DAMPING;
        self.judge_by(problem, scales);
    }

    /// The same place, judged by other standard deviations.
    fn judge_by(&mut self, problem: &Problem<'_>, scales: &Scales) {
        self.bend = None;
        self.curvature.look_away();
        self.objective = self.state.objective(problem, scales);
    }

    /// Steps until one gains less than `tolerance`; whether that came about.
    fn descend(&mut self, problem: &Problem<'_>, scales: &Scales, tolerance: f64, most: usize) -> bool {
        while self.iterations < most && self.damping < STUCK {
            self.iterations += 1;
            let Some((tried, objective)) = self.attempt(problem, scales) else {
                self.reject();
                continue;
            };
            let gain = self.objective - objective;
            let settled = gain.abs() < tolerance && self.damping < SHORT_STEP;
            if gain > 0.0 {
                let Some(state) = self.allowed(problem, tried) else {
                    self.reject();
                    continue;
                };
                self.state = state;
                self.objective = objective;
                self.floor = (DAMPING_NEAR * self.damping).clamp(LEAST_FLOOR, FIRST_DAMPING);
                self.damping = (DAMPING_FALL * self.damping).max(LEAST_DAMPING);
                self.bend = None;
                self.failed = false;
            } else {
                self.bend = Some(Bend::between(&self.state, tried.place()));
                self.reject();
            }
            if settled {
                return true;
            }
        }
        self.damping = self.damping.min(SHORT_STEP);
        false
    }

    /// Where a step that gains something leads, if the model predicts all there that it is to predict.
    fn allowed(&self, problem: &Problem<'_>, tried: Tried) -> Option<State> {
        let is_predicted = |run: &&UnseenRun| run.is_predicted(problem, &tried.place().parameters);
        let all = self.watched.iter().all(is_predicted);
        if all { tried.state(problem) } else { None }
    }

    /// A step that was too bold: the next is shorter, and without what was learned of the curvature.
    fn reject(&mut self) {
        self.failed = true;
        self.curvature.forget();
        self.damping = (DAMPING_RISE * self.damping).max(self.floor);
    }

    fn attempt(&mut self, problem: &Problem<'_>, scales: &Scales) -> Option<(Tried, f64)> {
        let mut equations = NormalEquations::new(problem, &self.state, scales, self.damping);
        self.curvature.see(&self.state.parameters, &equations);
        equations.information = self.curvature.corrected(&equations.information);
        let mut step = equations.step(problem, &self.state, self.damping)?;
        if let Some(bend) = &self.bend {
            let bent = bend.allowed_for(&self.state, &step, &equations.information);
            let again = NormalEquations::new(problem, &bent, scales, self.damping);
            step = again.step(problem, &bent, self.damping)?;
        }
        // After one step that failed, the next is likely to.
        let tried = self.state.after(problem, &step, !self.failed)?;
        let objective = tried.place().objective(problem, scales);
        objective.is_finite().then_some((tried, objective))
    }
}
