//! Where a fit stands: parameters, latents and offsets, what the model predicts there, and how well that agrees.

use std::ops::Deref;
use std::sync::Arc;

use nalgebra::{DVector, Vector2};

use super::model::{Coordinate, Derivatives, Latent};
use super::observation::{CHANNELS, Channels, Row};
use super::problem::{Problem, within};

/// Standard deviations that are estimated or given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    /// Factor on the noise of each channel.
    pub noise: [f64; CHANNELS],
    /// τ of the run offsets in the channel's unit; 0 where there are none.
    pub offset: [f64; CHANNELS],
}

impl Scales {
    /// One standard deviation of a reading.
    pub(super) fn noise(&self, row: &Row, channel: usize) -> f64 {
        self.noise[channel] * row.noise[channel]
    }
}

/// A place that a fit may come to. Latents, offsets and values are by run.
#[derive(Debug, Clone)]
pub(super) struct Place {
    pub parameters: DVector<f64>,
    pub latents: Vec<Vec<Latent>>,
    pub offsets: Vec<Channels>,
    /// What the model expects of the readings.
    pub values: Vec<Vec<[f64; CHANNELS]>>,
}

/// Where a fit stands: a place, and how what the model expects changes from there.
#[derive(Debug, Clone)]
pub(super) struct State {
    pub place: Place,
    /// By run.
    pub slopes: Arc<Vec<Vec<Derivatives>>>,
}

/// Where a step led: many a one is judged by the values there alone, and not taken.
pub(super) enum Tried {
    /// With the values.
    Seen(Place),
    /// With the slopes as well.
    Known(State),
}

impl Deref for State {
    type Target = Place;

    fn deref(&self) -> &Place {
        &self.place
    }
}

/// A step from a state.
pub(super) struct Step {
    pub parameters: DVector<f64>,
    /// By run, then by row: slip and load.
    pub latents: Vec<Vec<Vector2<f64>>>,
    /// By run.
    pub offsets: Vec<Channels>,
}

impl Step {
    /// None at all.
    pub(super) fn none(state: &State) -> Self {
        Self {
            parameters: DVector::zeros(state.parameters.len()),
            latents: state.latents.iter().map(|latents| vec![Vector2::zeros(); latents.len()]).collect(),
            offsets: vec![Channels::zeros(); state.offsets.len()],
        }
    }
}

impl State {
    /// At some parameters without offsets; none where the model predicts nothing there.
    pub(super) fn at(problem: &Problem<'_>, parameters: DVector<f64>) -> Option<Self> {
        let latents = problem.runs.iter().map(|run| run.rows.iter().map(|&row| problem.latent_start[row]).collect());
        let offsets = vec![Channels::zeros(); problem.runs.len()];
        Place { parameters, latents: latents.collect(), offsets, values: Vec::new() }.with_slopes(problem)
    }

    /// A step further, latents kept in their ranges; none where the model predicts nothing there. Slopes are had at once where
    /// they are `wanted`, which is quicker than to come back for them.
    pub(super) fn after(&self, problem: &Problem<'_>, step: &Step, wanted: bool) -> Option<Tried> {
        let moved = |(latents, steps): (&Vec<Latent>, &Vec<Vector2<f64>>)| {
            let moved = |(latent, step): (&Latent, &Vector2<f64>)| {
                within(
                    problem.options,
                    Latent { slip: latent.slip + step[0], load_n: latent.load_n + step[1], ..*latent },
                )
            };
            latents.iter().zip(steps).map(moved).collect()
        };
        let mut parameters = &self.parameters + &step.parameters;
        for (value, coordinate) in parameters.iter_mut().zip(problem.coordinates()) {
            *value = value.clamp(coordinate.low, coordinate.high);
        }
        let latents = self.latents.iter().zip(&step.latents).map(moved).collect();
        let offsets = self.offsets.iter().zip(&step.offsets).map(|(offset, step)| offset + step).collect();
        let place = Place { parameters, latents, offsets, values: Vec::new() };
        if wanted { place.with_slopes(problem).map(Tried::Known) } else { place.with_values(problem).map(Tried::Seen) }
    }
}

impl Tried {
    /// The place.
    pub(super) fn place(&self) -> &Place {
        match self {
            Self::Seen(place) => place,
            Self::Known(state) => state,
        }
    }

    /// With its slopes; none where the model has none.
    pub(super) fn state(self, problem: &Problem<'_>) -> Option<State> {
        match self {
            Self::Seen(place) => place.with_slopes(problem),
            Self::Known(state) => Some(state),
        }
    }
}

impl Place {
    /// With the values there.
    fn with_values(self, problem: &Problem<'_>) -> Option<Self> {
        let runs = problem.by_run(|index, run| {
            let mut latents = self.latents[index].clone();
            let values = problem.values(&self.parameters, run, &mut latents)?;
            Some((latents, values))
        });
        let (latents, values) = runs.into_iter().collect::<Option<Vec<_>>>()?.into_iter().unzip();
        Some(Self { latents, values, ..self })
    }

    /// With values and slopes.
    fn with_slopes(self, problem: &Problem<'_>) -> Option<State> {
        let runs = problem.by_run(|index, run| {
            let mut latents = self.latents[index].clone();
            let predictions = problem.predict(&self.parameters, run, &mut latents)?;
            let (values, slopes): (Vec<_>, Vec<_>) =
                predictions.into_iter().map(|prediction| (prediction.value, prediction.slopes)).unzip();
            Some(((latents, values), slopes))
        });
        let (places, slopes): (Vec<_>, Vec<_>) = runs.into_iter().collect::<Option<Vec<_>>>()?.into_iter().unzip();
        let (latents, values) = places.into_iter().unzip();
        Some(State { place: Self { latents, values, ..self }, slopes: Arc::new(slopes) })
    }

    /// What is minimised: losses of the readings, and half the squares of offsets, latents and parameters by their priors.
    pub(super) fn objective(&self, problem: &Problem<'_>, scales: &Scales) -> f64 {
        let readings: f64 = (0..problem.runs.len()).map(|run| self.run_objective(problem, scales, run)).sum();
        readings + self.parameter_penalty(problem)
    }

    /// Half the squares of the parameters by their priors.
    pub(super) fn parameter_penalty(&self, problem: &Problem<'_>) -> f64 {
        let penalty = |(coordinate, value): (&Coordinate, &f64)| coordinate.penalty(*value);
        problem.coordinates().iter().zip(&self.parameters).map(penalty).sum()
    }

    fn run_objective(&self, problem: &Problem<'_>, scales: &Scales, run: usize) -> f64 {
        let offsets = (0..CHANNELS).filter(|&c| scales.offset[c] > 0.0);
        let offset_penalty: f64 = offsets.map(|c| 0.5 * (self.offsets[run][c] / scales.offset[c]).powi(2)).sum();
        let rows = problem.runs[run].rows.iter().enumerate();
        let row_loss = |(place, &row): (usize, &usize)| {
            let standardised = self.standardised(&problem.rows[row], scales, run, place);
            let losses: f64 = standardised.iter().flatten().map(|&t| problem.huber.loss(t)).sum();
            losses + self.latent_penalty(problem, run, place, row)
        };
        offset_penalty + rows.map(row_loss).sum::<f64>()
    }

    fn latent_penalty(&self, problem: &Problem<'_>, run: usize, place: usize, row: usize) -> f64 {
        let away = latent_difference(&self.latents[run][place], &problem.latent_start[row]);
        let std = problem.options.latent_prior_std;
        0.5 * ((away[0] / std[0]).powi(2) + (away[1] / std[1]).powi(2))
    }

    /// Residuals of a row in units of its noise; none where not measured.
    pub(super) fn standardised(&self, row: &Row, scales: &Scales, run: usize, place: usize) -> [Option<f64>; CHANNELS] {
        let value = &self.values[run][place];
        std::array::from_fn(|c| {
            row.readings[c].map(|reading| (reading - value[c] - self.offsets[run][c]) / scales.noise(row, c))
        })
    }
}

/// Slip and load of one latent less another's.
pub(super) fn latent_difference(one: &Latent, other: &Latent) -> Vector2<f64> {
    Vector2::new(one.slip - other.slip, one.load_n - other.load_n)
}
