//! The iteration: Gauss–Newton's method, damped or not.

use crate::scalar::Scalar;

use super::super::SoilPrior;
use super::drawbar_pull::DrawbarPulls;
use super::{Equations, Unknowns};

/// How the iteration steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Steps {
    /// With Levenberg's damping, within bounds.
    Damped,
    /// As Newton's method has it: the whole step, whatever it does, and no bounds. It is here to be compared with.
    Whole,
}

/// Steps until the search is given up.
const MOST_STEPS: u8 = 60;

/// Between what the logarithms of the unknowns are searched.
pub(super) struct Bounds<S> {
    low: Unknowns<S>,
    high: Unknowns<S>,
}

/// Where the search ended.
pub(super) struct Settled<S> {
    /// ln φ, ln K, ln k.
    pub at: Unknowns<S>,
    /// The equations there.
    pub equations: Equations<S>,
    /// Steps on the way.
    pub steps: u8,
}

impl<S: Scalar> Bounds<S> {
    /// Those of a belief.
    pub fn of(prior: &SoilPrior<S>) -> Self {
        let angle = &prior.friction_angle_rad;
        Self {
            low: [angle.low.ln(), prior.ln_shear_modulus.low, prior.ln_stiffness.low],
            high: [angle.high.ln(), prior.ln_shear_modulus.high, prior.ln_stiffness.high],
        }
    }

    /// Which unknowns are at no end.
    pub fn inside(&self, at: &Unknowns<S>) -> [bool; 3] {
        self.free(at, &[S::zero(); 3])
    }

    /// Which unknowns can follow the way down: those at no end, or on their way from it.
    fn free(&self, at: &Unknowns<S>, way: &Unknowns<S>) -> [bool; 3] {
        let mut free = [true; 3];
        let ends = self.low.iter().zip(&self.high);
        for ((free, (at, way)), (low, high)) in free.iter_mut().zip(at.iter().zip(way)).zip(ends) {
            *free = (at > low || *way > S::zero()) && (at < high || *way < S::zero());
        }
        free
    }

    fn held(&self, at: Unknowns<S>) -> Unknowns<S> {
        let mut held = at;
        for (held, (&low, &high)) in held.iter_mut().zip(self.low.iter().zip(&self.high)) {
            *held = held.max(low).min(high);
        }
        held
    }
}

/// The logarithms at which the drawbar pulls are best met; none where the iteration does not settle.
pub(super) fn search<S: Scalar>(pulls: &DrawbarPulls<'_, S>, bounds: &Bounds<S>, steps: Steps) -> Option<Settled<S>> {
    match steps {
        Steps::Damped => damped(pulls, bounds),
        Steps::Whole => whole(pulls),
    }
}

/// A step this long, in the logarithms, is the last: what the rounding of the drawbar pulls leaves of them.
fn short_enough<S: Scalar>() -> S {
    if S::EPSILON > 1e-10 { S::constant(2e-4) } else { S::constant(1e-8) }
}

fn damped<S: Scalar>(pulls: &DrawbarPulls<'_, S>, bounds: &Bounds<S>) -> Option<Settled<S>> {
    let mut at = bounds.held(pulls.start());
    let mut equations = pulls.equations(&at)?;
    let mut damping = S::constant(1e-2);
    for steps in 1..=MOST_STEPS {
        let free = bounds.free(&at, &[0, 1, 2].map(|place| equations.descent(place)));
        // Nothing to follow: every derivative is zero.
        let change = equations.damped_solution(damping, &free).unwrap_or([S::zero(); 3]);
        let trial = bounds.held(moved(&at, &change));
        let settled = longest(&at, &trial) <= short_enough();
        match pulls.equations(&trial) {
            Some(better) if better.cost_at_zero() < equations.cost_at_zero() => {
                (at, equations) = (trial, better);
                damping = (damping * S::constant(0.1)).max(S::constant(1e-12));
            }
            _ => damping = damping * S::constant(10.0),
        }
        if settled {
            return Some(Settled { at, equations, steps });
        }
    }
    None
}

fn whole<S: Scalar>(pulls: &DrawbarPulls<'_, S>) -> Option<Settled<S>> {
    let mut at = pulls.start();
    for steps in 1..=MOST_STEPS {
        let next = moved(&at, &pulls.equations(&at)?.solution()?);
        let settled = longest(&at, &next) <= short_enough();
        at = next;
        if settled {
            return Some(Settled { at, equations: pulls.equations(&at)?, steps });
        }
    }
    None
}

fn moved<S: Scalar>(at: &Unknowns<S>, change: &Unknowns<S>) -> Unknowns<S> {
    let mut moved = *at;
    moved.iter_mut().zip(change).for_each(|(at, &change)| *at += change);
    moved
}

fn longest<S: Scalar>(one: &Unknowns<S>, other: &Unknowns<S>) -> S {
    one.iter().zip(other).map(|(&a, &b)| (a - b).abs()).fold(S::zero(), Scalar::max)
}
