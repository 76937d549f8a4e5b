//! A model tried on a campaign: fitted, and judged on runs that it has not seen.

use super::campaign_model::CampaignModel;
use super::fit::{
    Coordinate, Fit, FitError, Model, OffsetStd, Options, Reading, Start, fit_from_many, fit_without, scattered_starts,
};
use super::measurements::Measurements;
use super::specification::{EffectForm, Specification};
use crate::data::campaign::Campaign;

/// Starts of the declared model's fit.
const STARTS: usize = 6;
/// Seed of the places where they lie.
const SEED: u32 = 1;

/// A model fitted to a campaign.
#[derive(Debug, Clone)]
pub struct Trial<'a> {
    /// Its effects.
    pub specification: Specification,
    /// The model.
    pub model: CampaignModel<'a>,
    /// The fit.
    pub fit: Fit,
}

/// A campaign as every trial sees it.
#[derive(Debug, Clone)]
pub struct Bench<'a> {
    /// The campaign.
    pub campaign: &'a Campaign,
    /// Its rows.
    pub measurements: &'a Measurements,
    /// How fits are done.
    pub options: Options,
    /// Runs that take no part in any fit.
    pub without: Vec<usize>,
}

impl<'a> Bench<'a> {
    /// All runs of a campaign.
    pub fn new(campaign: &'a Campaign, measurements: &'a Measurements) -> Self {
        let mut options = Options { most_iterations: 40, ..Options::default() };
        for reading in Reading::JUDGED {
            options.estimate_noise[reading.index()] = !measurements.noise[reading.index()].stated;
        }
        if measurements.runs.len() < 3 {
            options.offsets = options.offsets.map(|_| OffsetStd::None);
        }
        Self { campaign, measurements, options, without: Vec::new() }
    }

    /// The same without some runs.
    pub fn without(&self, runs: &[usize]) -> Self {
        Self { without: runs.to_vec(), ..self.clone() }
    }

    /// A model's fit from many starts.
    ///
    /// # Errors
    /// Where no start leads to a fit.
    pub fn from_many_starts(&self, specification: Specification) -> Result<Trial<'a>, FitError> {
        let model = CampaignModel::new(self.campaign, self.measurements, &specification);
        let starts = scattered_starts(&model, &self.measurements.rows, STARTS, SEED);
        let fit = fit_from_many(&model, &self.measurements.rows, &starts, &self.options)?.best;
        Ok(Trial { specification, model, fit })
    }

    /// A model with one more effect, from the fit of that without.
    pub fn with_effect(&self, base: &Trial<'a>, effect: &EffectForm) -> Option<Trial<'a>> {
        let specification = base.specification.with(effect.clone());
        let model = CampaignModel::new(self.campaign, self.measurements, &specification);
        let mut parameters = base.fit.parameters.clone();
        parameters.extend(model.coordinates().iter().skip(parameters.len()).map(|coordinate| coordinate.start));
        let start = Start { parameters, latents: base.fit.latents.clone() };
        let fit = fit_without(&model, &self.measurements.rows, &self.without, &start, &self.options).ok()?;
        Some(Trial { specification, model, fit })
    }

    /// A trial fitted anew to this bench's runs.
    pub fn refit(&self, trial: &Trial<'a>) -> Option<Trial<'a>> {
        let start = Start { parameters: trial.fit.parameters.clone(), latents: trial.fit.latents.clone() };
        let rows = &self.measurements.rows;
        let fit = fit_without(&trial.model, rows, &self.without, &start, &self.options).ok()?;
        Some(Trial { fit, ..trial.clone() })
    }
}

impl Trial<'_> {
    /// ln of likelihood and of the Gaussian priors, up to a constant that every model of a campaign shares.
    pub fn log_posterior(&self) -> f64 {
        self.fit.log_likelihood + self.log_prior(&self.fit.parameters)
    }

    /// ln of the Gaussian priors at some parameters, up to a constant. Flat priors, whose bounds are wide, count nothing.
    pub fn log_prior(&self, parameters: &[f64]) -> f64 {
        let penalty = |(coordinate, value): (&Coordinate, &f64)| {
            coordinate.prior.map_or(0.0, |(mean, std)| -0.5 * ((value - mean) / std).powi(2))
        };
        self.model.coordinates().iter().zip(parameters).map(penalty).sum()
    }

    /// Parameters that the last effect frees.
    pub fn added_parameters(&self) -> usize {
        self.specification.effects.last().map_or(0, |effect| effect.form.free.len())
    }
}
