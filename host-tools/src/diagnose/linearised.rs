//! A fitted model near its optimum, with terms added to its readings: cheap enough to try hundreds of them.

use std::sync::Arc;

use super::campaign_model::CampaignModel;
use super::fit::{
    CHANNELS, Coordinate, Derivatives, Fit, FitError, HeldOutRun, Latent, Model, Options, Prediction, Reading, Row,
    Start, fit,
};
use super::measurements::Measurements;

/// Terms added to a channel, each times a coefficient that is fitted.
#[derive(Debug, Clone)]
pub struct AddedTerms {
    /// The channel.
    pub channel: Reading,
    /// The terms.
    pub terms: Vec<Term>,
}

/// A term's value in each row, about one in size, and how it follows the true slip and load.
///
/// A term made of readings of slip and load would be wrong by their noise, and so would not agree with the model's own
/// derivatives: a combination of both is then nothing but the noise, which every residual follows. So a term is taken where
/// the model is: at a slip and load that are independent of what a fit leaves, see [`super::settings::Settled`]. Nor does it change how the model answers to slip and load, as little as the model's
/// parameters do to first order: what only one of both did would be free to undo that answer.
#[derive(Debug, Clone)]
pub struct Term {
    /// Its value in each row.
    pub values: Vec<f64>,
    /// How it follows slip and load; none where it does not.
    pub slopes: Option<Slopes>,
}

/// Derivatives by the true slip and load (1/N) of each row, and where they were taken.
#[derive(Debug, Clone)]
pub struct Slopes {
    /// The derivatives.
    pub by: Vec<[f64; 2]>,
    /// Slip and load, N, at which the values hold.
    pub at: Arc<[[f64; 2]]>,
}

impl Term {
    /// A term that follows neither slip nor load.
    pub fn steady(values: Vec<f64>) -> Self {
        Self { values, slopes: None }
    }

    /// Its value in a row at a slip and load.
    fn at(&self, row: usize, latent: &Latent) -> f64 {
        self.slopes.as_ref().map_or(self.values[row], |slopes| {
            let ([by_slip, by_load], [slip, load_n]) = (slopes.by[row], slopes.at[row]);
            self.values[row] + by_slip * (latent.slip - slip) + by_load * (latent.load_n - load_n)
        })
    }
}

/// A model to first order about a fit of it.
#[derive(Debug, Clone)]
pub struct Linearised<'a> {
    rows: &'a [Row],
    coordinates: Vec<Coordinate>,
    parameters: Vec<f64>,
    latents: Vec<Latent>,
    predictions: Vec<Prediction>,
    options: Options,
}

/// The same with added terms.
#[derive(Debug, Clone)]
pub struct WithTerms<'a> {
    base: &'a Linearised<'a>,
    added: &'a AddedTerms,
    coordinates: Vec<Coordinate>,
}

impl<'a> Linearised<'a> {
    /// The model of a fit about that fit, at slips and loads apart from what it leaves; none where the model predicts nothing
    /// there.
    pub fn about(
        model: &CampaignModel<'_>,
        found: &Fit,
        rows: &'a [Row],
        measurements: &Measurements,
        options: &Options,
    ) -> Option<Self> {
        let mut latents = measurements.settled.apart_from_residuals(rows, &found.latents);
        let mut predictions = vec![None; rows.len()];
        for of_run in &measurements.rows_of_run {
            let mut here: Vec<Latent> = of_run.iter().map(|row| latents[*row]).collect();
            for (row, prediction) in of_run.iter().zip(model.predict(&found.parameters, of_run, &mut here)?) {
                predictions[*row] = Some(prediction);
            }
            for (row, latent) in of_run.iter().zip(here) {
                latents[*row] = latent;
            }
        }
        Some(Self {
            rows,
            coordinates: model.coordinates().to_vec(),
            parameters: found.parameters.clone(),
            latents,
            predictions: predictions.into_iter().collect::<Option<_>>()?,
            options: options.clone(),
        })
    }

    /// The model with added terms.
    pub fn with<'b>(&'b self, added: &'b AddedTerms) -> WithTerms<'b> {
        let mut coordinates = self.coordinates.clone();
        for index in 0..added.terms.len() {
            coordinates.push(Coordinate {
                name: format!("term {index}"),
                low: f64::NEG_INFINITY,
                high: f64::INFINITY,
                start: 0.0,
                prior: None,
            });
        }
        WithTerms { base: self, added, coordinates }
    }

    /// What the fit expects of a reading in each row.
    pub fn expected(&self, reading: Reading) -> impl Iterator<Item = f64> {
        self.predictions.iter().map(move |prediction| prediction.value[reading.index()])
    }

    /// True slip and load of each row, where the model was linearised.
    pub fn latents(&self) -> &[Latent] {
        &self.latents
    }

    /// How a reading follows the true slip and load in each row.
    pub fn slopes(&self, reading: Reading) -> impl Iterator<Item = [f64; 2]> {
        let c = reading.index();
        self.predictions.iter().map(move |prediction| [prediction.slopes.by_slip[c], prediction.slopes.by_load[c]])
    }

    /// A fit with added terms.
    ///
    /// # Errors
    /// See [`FitError`].
    pub fn fit_with(&self, added: &AddedTerms) -> Result<Fit, FitError> {
        let model = self.with(added);
        let mut parameters = self.parameters.clone();
        parameters.resize(model.coordinates.len(), 0.0);
        let start = Start { parameters, latents: self.latents.clone(), scales: None };
        fit(&model, self.rows, &start, &self.options)
    }

    /// Each run predicted without its own help by a fit with added terms.
    pub fn held_out(&self, added: &AddedTerms, found: &Fit, runs: usize) -> Option<Vec<HeldOutRun>> {
        let model = self.with(added);
        let predicted = found.leave_each_out(&model, 0..runs).ok()?;
        predicted.into_iter().map(|mut of_run| of_run.runs.pop()).collect()
    }
}

impl WithTerms<'_> {
    /// How a row's readings change: as where the model was linearised, and as the terms have it.
    fn derivatives(&self, row: usize) -> Derivatives {
        let about = &self.base.predictions[row].slopes;
        let own = about.by_parameter.iter().copied();
        let of_term = |term: &Term| {
            let mut slope = [0.0; CHANNELS];
            slope[self.added.channel.index()] = term.at(row, &self.base.latents[row]);
            slope
        };
        let by_parameter = own.chain(self.added.terms.iter().map(of_term)).collect();
        Derivatives { by_parameter, ..*about }
    }
}

impl Model for WithTerms<'_> {
    fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    fn predict(&self, parameters: &[f64], rows: &[usize], latents: &mut [Latent]) -> Option<Vec<Prediction>> {
        let values = self.values(parameters, rows, latents)?;
        let predict = |(row, value): (&usize, [f64; CHANNELS])| Prediction { value, slopes: self.derivatives(*row) };
        Some(rows.iter().zip(values).map(predict).collect())
    }

    fn values(&self, parameters: &[f64], rows: &[usize], latents: &mut [Latent]) -> Option<Vec<[f64; CHANNELS]>> {
        let base = self.base;
        let (own, coefficients) = parameters.split_at_checked(base.parameters.len())?;
        let channel = self.added.channel.index();
        let moved: Vec<f64> = own.iter().zip(&base.parameters).map(|(now, then)| now - then).collect();
        let value = |(row, latent): (&usize, &Latent)| {
            let about = &base.predictions[*row];
            let (mut value, slopes) = (about.value, &about.slopes);
            let then = &base.latents[*row];
            let (slip, load_n) = (latent.slip - then.slip, latent.load_n - then.load_n);
            for (reading, value) in value.iter_mut().enumerate() {
                let by_parameters: f64 =
                    moved.iter().zip(&slopes.by_parameter).map(|(by, slope)| by * slope[reading]).sum();
                *value += by_parameters + slip * slopes.by_slip[reading] + load_n * slopes.by_load[reading];
            }
            for (term, coefficient) in self.added.terms.iter().zip(coefficients) {
                value[channel] += coefficient * term.at(*row, then);
            }
            value
        };
        Some(rows.iter().zip(latents.iter()).map(value).collect())
    }
}
