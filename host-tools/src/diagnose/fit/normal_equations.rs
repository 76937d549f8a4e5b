//! The normal equations of the parameters.

use nalgebra::{DMatrix, DVector};

use super::bounds::bounded_step;
use super::problem::Problem;
use super::run_terms::RunTerms;
use super::state::{Scales, State, Step};

/// Share of the bounds' own precision that keeps a step finite where no reading says anything of a coordinate.
const FLOOR: f64 = 1e-6;
/// The same where a bound is infinite.
const LEAST_PRECISION: f64 = 1e-12;

/// Normal equations of the parameters, all else eliminated.
pub(super) struct NormalEquations {
    pub runs: Vec<RunTerms>,
    /// Curvature of the objective, priors included.
    pub information: DMatrix<f64>,
    /// Negative slope of the objective, priors included.
    pub pull: DVector<f64>,
}

impl NormalEquations {
    /// At a state. `damping` lengthens the diagonals of all that is eliminated.
    pub(super) fn new(problem: &Problem<'_>, state: &State, scales: &Scales, damping: f64) -> Self {
        let runs = problem.by_run(|run, _| RunTerms::new(problem, state, scales, run, damping));
        Self::of_runs(problem, state, runs)
    }

    /// The same undamped with other standard deviations.
    pub(super) fn at_scales(self, problem: &Problem<'_>, state: &State, scales: &Scales) -> Self {
        if problem.options.estimate_noise.contains(&true) {
            return Self::new(problem, state, scales, 0.0);
        }
        // The rows know nothing of the offsets.
        let mut runs = self.runs;
        for (run, offsets) in runs.iter_mut().zip(&state.offsets) {
            run.eliminate_offsets(offsets, scales, 0.0);
        }
        Self::of_runs(problem, state, runs)
    }

    fn of_runs(problem: &Problem<'_>, state: &State, runs: Vec<RunTerms>) -> Self {
        let count = state.parameters.len();
        let mut information = DMatrix::zeros(count, count);
        let mut pull = DVector::zeros(count);
        for run in &runs {
            information += &run.information;
            pull += &run.pull;
        }
        for (p, coordinate) in problem.coordinates().iter().enumerate() {
            if let Some((mean, std)) = coordinate.prior {
                information[(p, p)] += 1.0 / (std * std);
                pull[p] -= (state.parameters[p] - mean) / (std * std);
            }
        }
        Self { runs, information, pull }
    }

    /// The step to the minimum of the quadratic model within the bounds, the diagonal lengthened by `damping`; none where the
    /// equations cannot be solved.
    pub(super) fn step(&self, problem: &Problem<'_>, state: &State, damping: f64) -> Option<Step> {
        let (low, high) = problem.room(&state.parameters);
        let mut damped = with_floor(problem, &self.information);
        for p in 0..damped.nrows() {
            damped[(p, p)] *= 1.0 + damping;
        }
        let parameters = bounded_step(&damped, &self.pull, &low, &high)?;
        let followed = self.runs.iter().zip(state.slopes.iter()).map(|(run, seen)| run.follow(seen, &parameters));
        let (offsets, latents) = followed.unzip();
        Some(Step { parameters, latents, offsets })
    }
}

/// Curvature with so much added that a coordinate of which nothing is known has some.
pub(super) fn with_floor(problem: &Problem<'_>, information: &DMatrix<f64>) -> DMatrix<f64> {
    let mut raised = information.clone();
    for (p, coordinate) in problem.coordinates().iter().enumerate() {
        raised[(p, p)] += (FLOOR * coordinate.box_precision()).max(LEAST_PRECISION);
    }
    raised
}

/// Covariance of the parameters from their curvature. The bounds count as the Gaussian of their width (12 / width²), so that
/// no variance exceeds that of knowing the bounds alone; none where the matrix is not positive definite.
pub(super) fn bounded_covariance(problem: &Problem<'_>, information: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let mut limited = information.clone();
    for (p, coordinate) in problem.coordinates().iter().enumerate() {
        limited[(p, p)] += coordinate.box_precision().max(LEAST_PRECISION);
    }
    limited.cholesky().map(|factor| factor.inverse())
}
