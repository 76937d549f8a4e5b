//! The mode: the least of the minima that are found from several places of the prior.

use heapless::Vec;

use crate::identification::Refusal;
use crate::scalar::Scalar;

use super::descent::{Descent, Patience, descend};
use super::problem::{Fit, Held, Problem, State};
use super::unknowns::{COHESION, FRICTION, MODULUS, Point, STIFFNESS, UNKNOWNS};

/// Coordinates of cohesion, friction angle and modulus: in the middle, and at both ends of the ridge on which a weak soil
/// that holds early and a strong one that holds late explain much the same.
const STARTS: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [0.5, -1.3, -1.0], [-0.5, 1.3, 1.0]];
/// Coordinates of the stiffness, of which each is gone from where no minimum that was found before explains the observations: on soil so
/// stiff or so soft that wheels sink a tenth or ten times as deep the way from the middle is long, and ends in minima on which loads are
/// borne at depths that are not true.
const STIFFNESSES: [f64; 5] = [0.0, 2.0, -2.0, 4.0, -4.0];

/// By how much the noise is taken too great on the way.
const BLURS: [f64; 2] = [16.0, 4.0];

/// Ways that come so near to each other in all coordinates, under the same noise, lead to the same minimum.
const NEAR: f64 = 0.5;

/// Descends from all starts, on soil of one stiffness after the other until what is found is not beyond chance. One that comes near to where
/// an earlier one was is not gone to its end.
pub(super) fn best_mode<const N: usize, S: Scalar>(problem: &Problem<'_, S>) -> Result<Descent<S, N>, Refusal> {
    let (patience, held) = (patience(), problem.known());
    let mut best: Option<Descent<S, N>> = None;
    let mut ways = Ways { passed: [const { Vec::new() }; BLURS.len()], steps: 0 };
    let explains = |best: &Descent<S, N>| !is_beyond_chance(best.fit.cost, problem.degrees_of_freedom());
    for stiffness in STIFFNESSES {
        if best.as_ref().is_some_and(explains) {
            break;
        }
        for start in STARTS {
            let start = problem.forward.unknowns.inside(&coordinates(stiffness, start));
            // Under much noise what is believed would draw any other back to the middle.
            let state = if stiffness == 0.0 {
                ways.approach(problem, &start, &held, &patience)
            } else {
                Some(problem.start(&start))
            };
            let Some(state) = state else { continue };
            let Some(found) = descend(problem, state, &held, &patience) else { continue };
            ways.steps += found.steps;
            if best.as_ref().is_none_or(|best| found.fit.cost < best.fit.cost) {
                best = Some(found);
            }
        }
    }
    best.map(|best| Descent { steps: ways.steps, ..best }).ok_or(Refusal::NoSoilFits)
}

/// Whether a misfit is more than four of its standard deviations above its mean.
pub(super) fn is_beyond_chance<S: Scalar>(misfit: S, degrees_of_freedom: u16) -> bool {
    let mean = S::constant(f64::from(degrees_of_freedom));
    mean > S::zero() && misfit > mean + S::constant(4.0) * (mean + mean).sqrt()
}

/// Where the descent from a fit under another noise ends.
pub(super) fn mode_nearby<const N: usize, S: Scalar>(problem: &Problem<'_, S>, fit: &Fit<S, N>) -> Option<Fit<S, N>> {
    descend(problem, fit.state.clone(), &problem.known(), &patience()).map(|found| found.fit)
}

fn patience<S: Scalar>() -> Patience<S> {
    let gain = if S::EPSILON > 1e-10 { S::constant(2e-3) } else { S::constant(1e-6) };
    Patience { steps: 120, gain, damping: S::constant(0.03) }
}

fn coordinates<S: Scalar>(stiffness: f64, [cohesion, friction, modulus]: [f64; 3]) -> Point<S> {
    let mut point = [S::zero(); UNKNOWNS];
    for (place, shift) in [(STIFFNESS, stiffness), (COHESION, cohesion), (FRICTION, friction), (MODULUS, modulus)] {
        if let Some(slot) = point.get_mut(place) {
            *slot = S::constant(shift);
        }
    }
    point
}

/// The ways gone so far.
struct Ways<S> {
    /// Where they were at the end of each blur.
    passed: [Vec<Point<S>, { STARTS.len() }>; BLURS.len()],
    /// Steps of all.
    steps: u16,
}

impl<S: Scalar> Ways<S> {
    /// Goes from a start through the blurs; none where an earlier way has come by.
    fn approach<const N: usize>(
        &mut self,
        problem: &Problem<'_, S>,
        start: &Point<S>,
        held: &Held,
        patience: &Patience<S>,
    ) -> Option<State<S, N>> {
        let rough = Patience { steps: 10, gain: S::constant(0.1), ..*patience };
        let mut state = problem.start(start);
        for (blur, passed) in BLURS.into_iter().zip(&mut self.passed) {
            let blurred = Problem { blur: S::constant(blur), ..*problem };
            let Some(found) = descend(&blurred, state.clone(), held, &rough) else { continue };
            self.steps += found.steps;
            state = found.fit.state;
            if passed.iter().any(|point| is_near(point, &state.point)) {
                return None;
            }
            // As many as starts.
            let _ = passed.push(state.point);
        }
        Some(state)
    }
}

fn is_near<S: Scalar>(one: &Point<S>, other: &Point<S>) -> bool {
    one.iter().zip(other).all(|(a, b)| (*a - *b).abs() < S::constant(NEAR))
}
