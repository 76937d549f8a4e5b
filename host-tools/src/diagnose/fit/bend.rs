//! How far predictions after a step bent away from what their slopes at its start foretold.
//!
//! Where a step failed, that says what the next, shorter one will meet, and a step that allows for it follows a valley that
//! bends instead of running up its side (the geodesic acceleration of Transtrum & Sethna 2012, arXiv 1201.5885, with the second
//! derivative along the step taken from the step that failed).

use nalgebra::{DMatrix, DVector};

use super::observation::Channels;
use super::state::{Place, State, Step, latent_difference};

/// What a step from a state showed of the curvature of the predictions.
pub(super) struct Bend {
    /// The step, of the parameters.
    step: DVector<f64>,
    /// By run and row: the predictions after it, less what their slopes foretold.
    beyond: Vec<Vec<Channels>>,
}

impl Bend {
    /// From a state and where a step led.
    pub(super) fn between(here: &State, there: &Place) -> Self {
        let step = &there.parameters - &here.parameters;
        let row = |run: usize, place: usize| {
            let slopes = &here.slopes[run][place];
            let latents = latent_difference(&there.latents[run][place], &here.latents[run][place]);
            let by_parameters =
                slopes.by_parameter.iter().zip(step.iter()).map(|(by, step)| Channels::from(*by) * *step);
            let foretold = by_parameters.sum::<Channels>() + slopes.by_latents() * latents;
            Channels::from(there.values[run][place]) - Channels::from(here.values[run][place]) - foretold
        };
        let rows = |(run, values): (usize, &Vec<_>)| (0..values.len()).map(|place| row(run, place)).collect();
        let beyond = here.values.iter().enumerate().map(rows).collect();
        Self { step, beyond }
    }

    /// The state with its predictions where they will be after a step, as far as slopes do not tell: the curvature goes with
    /// the square of the step's length along the one that showed it, measured by the `information`.
    pub(super) fn allowed_for(&self, state: &State, next: &Step, information: &DMatrix<f64>) -> State {
        let shown = information * &self.step;
        let along = next.parameters.dot(&shown) / self.step.dot(&shown);
        let share = if along.is_finite() { along.clamp(0.0, 1.0) } else { 0.0 };
        let mut bent = state.clone();
        for (values, beyond) in bent.place.values.iter_mut().zip(&self.beyond) {
            for (value, beyond) in values.iter_mut().zip(beyond) {
                for (value, beyond) in value.iter_mut().zip(beyond.iter()) {
                    *value += share * share * beyond;
                }
            }
        }
        bent
    }
}
