//! A model, the rows that it is fitted to, and how.

use nalgebra::DVector;
use rayon::prelude::*;

use super::huber::Huber;
use super::model::{Coordinate, Derivatives, Latent, Model, Prediction};
use super::observation::{CHANNELS, Row};
use super::options::{FitError, Options};
use super::start::Start;
use super::state::Scales;
use super::unseen::UnseenRun;

/// The rows of one run.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RunRows {
    /// The run's number in its rows.
    pub id: usize,
    /// Indices of its rows, in order.
    pub rows: Vec<usize>,
}

/// A fit to do.
pub(super) struct Problem<'a> {
    pub model: &'a dyn Model,
    pub rows: &'a [Row],
    pub runs: Vec<RunRows>,
    /// Runs that take no part.
    pub unseen: Vec<UnseenRun>,
    pub options: &'a Options,
    pub huber: Huber,
    /// Of all rows: the middle of the latents' prior.
    pub latent_start: Vec<Latent>,
    /// Standard deviations to begin with.
    pub scales_start: Option<Scales>,
}

impl<'a> Problem<'a> {
    /// All runs but those `without`.
    pub(super) fn new(
        model: &'a dyn Model,
        rows: &'a [Row],
        without: &[usize],
        start: &Start,
        options: &'a Options,
    ) -> Result<Self, FitError> {
        if let Some(row) = rows.iter().position(|row| !row.is_sound()) {
            return Err(FitError::UnsoundRow { row });
        }
        let finite = |latent: &Latent| latent.slip.is_finite() && latent.load_n.is_finite();
        let fits = start.parameters.len() == model.coordinates().len()
            && start.latents.len() == rows.len()
            && start.parameters.iter().all(|value| value.is_finite())
            && start.latents.iter().all(finite);
        if !fits {
            return Err(FitError::UnfitStart);
        }
        let runs: Vec<RunRows> = runs_of(rows).into_iter().filter(|run| !without.contains(&run.id)).collect();
        if runs.is_empty() {
            return Err(FitError::NoRows);
        }
        let latent_start = start.latents.iter().map(|latent| within(options, *latent)).collect();
        Ok(Self {
            model,
            rows,
            runs,
            unseen: UnseenRun::of(rows, without, options),
            options,
            huber: Huber::new(options.huber),
            latent_start,
            scales_start: start.scales,
        })
    }

    pub(super) fn coordinates(&self) -> &[Coordinate] {
        self.model.coordinates()
    }

    /// `work` on every run, in parallel if that is asked for; results in the order of the runs.
    pub(super) fn by_run<T: Send>(&self, work: impl Fn(usize, &RunRows) -> T + Sync) -> Vec<T> {
        let task = |(index, run): (usize, &RunRows)| work(index, run);
        if self.options.parallel {
            self.runs.par_iter().enumerate().map(task).collect()
        } else {
            self.runs.iter().enumerate().map(task).collect()
        }
    }

    /// Predictions of a run, its latents' warm starts brought up to date; none where there are none, or not of numbers.
    pub(super) fn predict(
        &self,
        parameters: &DVector<f64>,
        run: &RunRows,
        latents: &mut [Latent],
    ) -> Option<Vec<Prediction>> {
        let predictions = warmed(latents, |seen| self.model.predict(parameters.as_slice(), &run.rows, seen))?;
        let sound = |(prediction, &row): (&Prediction, &usize)| {
            (0..CHANNELS).all(|c| self.rows[row].readings[c].is_none() || is_finite(prediction, c))
        };
        let whole = predictions.len() == run.rows.len()
            && predictions.iter().all(|prediction| prediction.slopes.by_parameter.len() == parameters.len());
        (whole && predictions.iter().zip(&run.rows).all(sound)).then_some(predictions)
    }

    /// The values of these alone.
    pub(super) fn values(
        &self,
        parameters: &DVector<f64>,
        run: &RunRows,
        latents: &mut [Latent],
    ) -> Option<Vec<[f64; CHANNELS]>> {
        let values = warmed(latents, |seen| self.model.values(parameters.as_slice(), &run.rows, seen))?;
        let sound = |(value, &row): (&[f64; CHANNELS], &usize)| {
            (0..CHANNELS).all(|c| self.rows[row].readings[c].is_none() || value[c].is_finite())
        };
        (values.len() == run.rows.len() && values.iter().zip(&run.rows).all(sound)).then_some(values)
    }

    /// Bounds of the parameters as displacements from a point.
    pub(super) fn room(&self, parameters: &DVector<f64>) -> (DVector<f64>, DVector<f64>) {
        let bounds = |bound: fn(&Coordinate) -> f64| {
            DVector::from_iterator(parameters.len(), self.coordinates().iter().map(bound)) - parameters
        };
        (bounds(|coordinate| coordinate.low), bounds(|coordinate| coordinate.high))
    }
}

/// What a model says of some latents, which it changes in their warm starts alone.
fn warmed<T>(latents: &mut [Latent], ask: impl FnOnce(&mut [Latent]) -> Option<T>) -> Option<T> {
    let mut seen = latents.to_vec();
    let answer = ask(&mut seen)?;
    for (latent, seen) in latents.iter_mut().zip(&seen) {
        latent.sinkage_m = seen.sinkage_m;
    }
    Some(answer)
}

fn is_finite(prediction: &Prediction, channel: usize) -> bool {
    let Derivatives { by_parameter, by_slip, by_load } = &prediction.slopes;
    prediction.value[channel].is_finite()
        && by_slip[channel].is_finite()
        && by_load[channel].is_finite()
        && by_parameter.iter().all(|derivatives| derivatives[channel].is_finite())
}

/// A latent moved into the ranges of true slip and load.
pub(super) fn within(options: &Options, latent: Latent) -> Latent {
    Latent {
        slip: latent.slip.clamp(options.slip_range.0, options.slip_range.1),
        load_n: latent.load_n.clamp(options.load_range_n.0, options.load_range_n.1),
        ..latent
    }
}

/// The runs in the order of their first rows.
pub(super) fn runs_of(rows: &[Row]) -> Vec<RunRows> {
    let mut runs: Vec<RunRows> = Vec::new();
    let mut place = std::collections::HashMap::new();
    for (index, row) in rows.iter().enumerate() {
        let at = *place.entry(row.run).or_insert(runs.len());
        if at == runs.len() {
            runs.push(RunRows { id: row.run, rows: Vec::new() });
        }
        runs[at].rows.push(index);
    }
    runs
}
