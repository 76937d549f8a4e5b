//! The sum of squares that is made least: observations and beliefs.

use heapless::Vec;

use crate::identification::Observation;
use crate::identification::least_squares::Triangle;
use crate::scalar::Scalar;
use crate::terramechanics::effects::Conditions;
use crate::terramechanics::{deepest_sinkage, sinkage_for_load};

use super::prediction::{Forward, LATENTS, Latents};
use super::rows::{LatentRows, Rows};
use super::unknowns::{Point, UNKNOWNS};

/// What is to be explained, and by what.
#[derive(Clone, Copy)]
pub(super) struct Problem<'a, S> {
    pub forward: Forward<'a, S>,
    pub observations: &'a [Observation<S>],
    /// Factor on the standard deviations of all channels.
    pub blur: S,
    /// Of each observation; nothing is known beyond the end of the slice.
    pub conditions: &'a [Conditions<S>],
}

/// Values of all unknowns of at most N observations.
#[derive(Debug, Clone)]
pub(super) struct State<S, const N: usize> {
    pub point: Point<S>,
    pub latents: Vec<Latents<S>, N>,
}

/// A state and how well it explains what was seen.
#[derive(Debug, Clone)]
pub(super) struct Fit<S, const N: usize> {
    pub state: State<S, N>,
    rows: Vec<Rows<S>, N>,
    /// Sum of the squared residuals of the observations.
    pub chi_squared: S,
    /// The same with those of the beliefs.
    pub cost: S,
}

/// A step of all unknowns.
#[derive(Debug, Clone)]
pub(super) struct Step<S, const N: usize> {
    shared: Point<S>,
    latents: Vec<[S; LATENTS], N>,
    /// By how much it should lower the cost.
    pub gain: S,
}

/// Which unknowns a descent may not move.
pub(super) type Held = [bool; UNKNOWNS];

impl<S: Scalar> Problem<'_, S> {
    /// Where the latents are looked for first: as measured; a sinkage that was not measured, or that is not told from none, is the one at
    /// which the soil of the point carries the load.
    pub fn start<const N: usize>(&self, point: &Point<S>) -> State<S, N> {
        let soil = self.forward.unknowns.soil_at(point);
        let wheel = self.forward.wheel;
        let mut latents = Vec::new();
        for observation in self.observations.iter().take(N) {
            let state = &observation.state;
            let slip = state.slip;
            let noise_m = observation.noise.sinkage_m;
            let measured = state.sinkage_m.filter(|sinkage_m| *sinkage_m > noise_m + noise_m);
            let sinkage_m = measured
                .or_else(|| sinkage_for_load(wheel, &soil, slip, state.load_n).ok())
                .unwrap_or(S::constant(0.2) * wheel.radius_m);
            let start = self.inside(Latents { ln_sinkage: sinkage_m.ln(), slip });
            // The slice is no longer than the capacity.
            let _ = latents.push(start);
        }
        State { point: *point, latents }
    }

    /// Latents for which the equations hold: sinkage of 1e-4 … 0.9 r, slip just inside −1 … 1.
    fn inside(&self, latents: Latents<S>) -> Latents<S> {
        let deepest = deepest_sinkage(self.forward.wheel);
        let shallowest = S::constant(1e-4) * self.forward.wheel.radius_m;
        Latents {
            ln_sinkage: latents.ln_sinkage.max(shallowest.ln()).min(deepest.ln()),
            slip: latents.slip.max(S::constant(-0.99)).min(S::constant(0.999)),
        }
    }

    /// The unknowns that are known.
    pub fn known(&self) -> Held {
        core::array::from_fn(|place| self.forward.unknowns.is_known(place))
    }

    /// Readings that were measured.
    pub fn residuals(&self) -> u16 {
        self.observations.iter().map(Observation::readings).sum::<usize>() as u16
    }

    /// Residuals of observations and beliefs less unknowns.
    pub fn degrees_of_freedom(&self) -> u16 {
        self.residuals().saturating_sub(2 * self.observations.len() as u16)
    }

    /// How well a state explains what was seen; none where the equations do not hold.
    pub fn evaluate<const N: usize>(&self, state: State<S, N>) -> Option<Fit<S, N>> {
        let mut rows = Vec::new();
        let mut chi_squared = S::zero();
        let unknown = Conditions::<()>::default().map(|()| S::zero());
        for (place, (observation, latents)) in self.observations.iter().zip(&state.latents).enumerate() {
            let conditions = self.conditions.get(place).unwrap_or(&unknown);
            let load_n = observation.state.load_n;
            let prediction = self.forward.predict(conditions, load_n, &state.point, latents)?;
            let own = Rows::new(observation, &prediction, self.blur);
            chi_squared += own.chi_squared();
            rows.push(own).ok()?;
        }
        let mut cost = chi_squared;
        for (place, scaled) in state.point.iter().enumerate() {
            if !self.forward.unknowns.is_known(place) {
                cost += *scaled * *scaled;
            }
        }
        cost.is_finite().then_some(Fit { state, rows, chi_squared, cost })
    }

    /// A state moved by a step, and into the bounds.
    pub fn moved<const N: usize>(&self, state: &State<S, N>, step: &Step<S, N>) -> State<S, N> {
        // Slopes say little of what is farther away, and least where a flat belief ends.
        let farthest = S::constant(1.5);
        let mut point = state.point;
        for (slot, shift) in point.iter_mut().zip(&step.shared) {
            *slot += shift.max(-farthest).min(farthest);
        }
        let mut latents = Vec::new();
        for (own, [by_ln_sinkage, by_slip]) in state.latents.iter().zip(&step.latents) {
            let most = S::constant(0.7);
            let ln_sinkage = own.ln_sinkage + by_ln_sinkage.max(-most).min(most);
            let _ = latents.push(self.inside(Latents { ln_sinkage, slip: own.slip + *by_slip }));
        }
        State { point: self.forward.unknowns.inside(&point), latents }
    }
}

impl<S: Scalar, const N: usize> Fit<S, N> {
    /// The shared unknowns' triangle, the latents taken out, without beliefs. The rows that tell the latents go by.
    pub fn of_observations(&self, damping: S, mut pass: impl FnMut(&Rows<S>, LatentRows<S>)) -> Triangle<S, UNKNOWNS> {
        let mut triangle = Triangle::new();
        for rows in &self.rows {
            pass(rows, rows.eliminate(damping, &mut triangle));
        }
        triangle
    }

    /// The same with the beliefs.
    pub fn of_everything(&self, damping: S, pass: impl FnMut(&Rows<S>, LatentRows<S>)) -> Triangle<S, UNKNOWNS> {
        let mut triangle = self.of_observations(damping, pass);
        for (place, coordinate) in self.state.point.iter().enumerate() {
            triangle.add_alone(place, S::one(), -*coordinate);
        }
        triangle
    }

    /// The state at a distance along the shared unknowns, with the latents that go with it to first order.
    pub fn beside(&self, problem: &Problem<'_, S>, shift: &Point<S>) -> State<S, N> {
        let mut latents = Vec::new();
        let _ = self.of_observations(S::zero(), |_, own| {
            // As many as observations.
            let _ = latents.push(own.step(shift));
        });
        problem.moved(&self.state, &Step { shared: *shift, latents, gain: S::zero() })
    }

    /// The damped step of least cost. Unknowns that are held, or whose descent leads out of their bounds, stay.
    pub fn step(&self, problem: &Problem<'_, S>, held: &Held, damping: S) -> Step<S, N> {
        let mut latents: Vec<LatentRows<S>, N> = Vec::new();
        let triangle = self.of_everything(damping, |_, own| {
            // As many as observations.
            let _ = latents.push(own);
        });
        let descent: Point<S> = core::array::from_fn(|place| triangle.descent(place));
        let stays: Held = core::array::from_fn(|place| {
            let (low, high) = problem.forward.unknowns.bounds(place);
            let at = self.state.point.get(place).copied().unwrap_or(S::zero());
            let downhill = descent.get(place).copied().unwrap_or(S::zero());
            let blocked = (at <= low && downhill <= S::zero()) || (at >= high && downhill >= S::zero());
            blocked || held.get(place).copied().unwrap_or(true)
        });
        let mut damped = Triangle::new();
        for (place, stays) in stays.iter().enumerate() {
            let length = triangle.length(place).max(S::one());
            damped.add_alone(place, if *stays { S::one() } else { damping * length }, S::zero());
        }
        damped.add_all_but(&triangle, &stays);
        let shared = damped.told_solution();
        let mut gain = S::zero();
        for (slope, step) in descent.iter().zip(&shared) {
            gain += *slope * *step;
        }
        for own in &latents {
            gain += own.square();
        }
        Step { shared, latents: latents.iter().map(|own| own.step(&shared)).collect(), gain }
    }
}
