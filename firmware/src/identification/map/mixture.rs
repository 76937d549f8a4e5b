//! Mean and spread of the posterior: normal in all directions but that of the cohesion, over which it is summed.
//!
//! The logarithm of a small cohesion is anything from what the data allow at most downwards, and as the cohesion takes part
//! of the strength, friction angle and shear modulus go with it: the posterior is a bent ridge with one long end. For a
//! cohesion that is held, the others are nearly normal. So the cohesion is moved in equal steps from the mode to both sides,
//! the others are fitted anew at each, and the normal distributions are mixed with the weights of their evidence (Laplace's
//! approximation at each: L. Tierney, J. B. Kadane, J. Am. Stat. Assoc. 81 (1986) 82–86; summed over the axes that are not
//! normal: H. Rue, S. Martino, N. Chopin, J. R. Stat. Soc. B 71 (2009) 319–392). Equal weights in equal steps of less than a
//! standard deviation integrate a smooth bell nearly exactly.

use heapless::Vec;

use crate::scalar::Scalar;

use super::descent::{Patience, descend};
use super::problem::{Fit, Held, Problem, State, conditional};
use super::unknowns::{COHESION, Point, UNKNOWNS};

/// Most steps to either side of the mode.
const REACH: usize = 8;

/// Mean and standard deviation of every unknown, as coordinates of a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moments<S> {
    pub mean: Point<S>,
    pub std: Point<S>,
    /// Descents' steps.
    pub steps: u16,
}

/// A normal distribution and its share of the posterior.
#[derive(Debug, Clone, Copy)]
struct Part<S> {
    ln_weight: S,
    mean: Point<S>,
    variance: Point<S>,
}

/// The posterior about its mode.
pub(super) fn moments<S: Scalar>(problem: &Problem<'_, S>, mode: &Fit<S>) -> Moments<S> {
    let mut held: Held = core::array::from_fn(|place| problem.forward.unknowns.is_known(place));
    let mut parts = Vec::<Part<S>, { 2 * REACH + 1 }>::new();
    let mut steps = 0;
    if problem.forward.unknowns.is_known(COHESION) {
        let _ = parts.push(part(problem, mode, &held));
        return mixed(&parts, steps);
    }
    let (triangle, _) = mode.of_everything(problem, S::zero(), true);
    let covariance = conditional(&triangle, &held).covariance();
    let slopes: Point<S> = covariance.get(COHESION).copied().unwrap_or([S::zero(); UNKNOWNS]);
    let variance = slopes.get(COHESION).copied().unwrap_or(S::one());
    let spacing = S::constant(0.8) * variance.sqrt().min(S::one());
    let towards = slopes.map(|covariance| covariance * spacing / variance);
    if let Some(slot) = held.get_mut(COHESION) {
        *slot = true;
    }
    let (low, high) = problem.forward.unknowns.bounds(COHESION);
    let middle = part(problem, mode, &held);
    let _ = parts.push(middle);
    for sign in [S::one(), -S::one()] {
        let mut state = mode.state.clone();
        let mut last = towards.map(|shift| sign * shift);
        for _ in 0..REACH {
            let ahead: Point<S> = core::array::from_fn(|place| {
                state.point.get(place).zip(last.get(place)).map_or(S::zero(), |(from, shift)| *from + *shift)
            });
            let cohesion = ahead.get(COHESION).copied().unwrap_or(S::zero());
            if cohesion < low || cohesion > high {
                break;
            }
            let point = problem.forward.unknowns.inside(&ahead);
            let start = State { point, latents: state.latents.clone() };
            let Some(found) = descend(problem, start, &held, &REFIT.of()) else { break };
            steps += found.steps;
            let here = part(problem, &found.fit, &held);
            let _ = parts.push(here);
            if here.ln_weight < middle.ln_weight - S::constant(6.0) {
                break;
            }
            last = core::array::from_fn(|place| {
                let (to, from) = (found.fit.state.point.get(place), state.point.get(place));
                to.zip(from).map_or(S::zero(), |(to, from)| *to - *from)
            });
            state = found.fit.state;
        }
    }
    mixed(&parts, steps)
}

/// Effort of a fit that starts next to its end.
struct Refit;
const REFIT: Refit = Refit;
impl Refit {
    fn of<S: Scalar>(&self) -> Patience<S> {
        Patience { steps: 4, gain: S::constant(1e-2), damping: S::constant(1e-3) }
    }
}

/// The normal distribution about a fit, with what is held at its place.
fn part<S: Scalar>(problem: &Problem<'_, S>, fit: &Fit<S>, held: &Held) -> Part<S> {
    let (triangle, _) = fit.of_everything(problem, S::zero(), true);
    let covariance = conditional(&triangle, held).covariance();
    let variance = core::array::from_fn(|place| {
        let is_held = held.get(place).copied().unwrap_or(true);
        let own = covariance.get(place).and_then(|row| row.get(place)).copied();
        if is_held { S::zero() } else { own.unwrap_or(S::zero()) }
    });
    Part { ln_weight: fit.ln_evidence(problem, held), mean: fit.state.point, variance }
}

/// Moments of the mixture.
fn mixed<S: Scalar>(parts: &[Part<S>], steps: u16) -> Moments<S> {
    let mut greatest = parts.first().map_or(S::zero(), |part| part.ln_weight);
    for part in parts {
        greatest = greatest.max(part.ln_weight);
    }
    let mut total = S::zero();
    let (mut mean, mut square) = ([S::zero(); UNKNOWNS], [S::zero(); UNKNOWNS]);
    let weight = |part: &Part<S>| (part.ln_weight - greatest).exp();
    for part in parts {
        total += weight(part);
        for (slot, own) in mean.iter_mut().zip(part.mean) {
            *slot += weight(part) * own;
        }
    }
    let mean = mean.map(|sum| sum / total);
    for part in parts {
        for ((slot, own), (centre, variance)) in
            square.iter_mut().zip(part.mean).zip(mean.iter().zip(part.variance))
        {
            let away = own - *centre;
            *slot += weight(part) * (away * away + variance);
        }
    }
    Moments { mean, std: square.map(|sum| (sum / total).max(S::zero()).sqrt()), steps }
}
