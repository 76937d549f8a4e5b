//! A campaign as every trial sees it: models fitted to it, with one effect more or less, to all of its runs or without some.

mod glance;

use std::ops::Range;

use super::campaign_model::CampaignModel;
use super::fit::{
    CHANNELS, Fit, FitError, HeldOutRun, Model, OffsetStd, Options, Reading, Row, Start, fit_from_many, fit_without,
    predictor_without, scattered_starts,
};
use super::measurements::Measurements;
use super::selection::MISFIT;
use super::specification::{EffectForm, Specification};
use super::trial::Trial;
use crate::data::campaign::Campaign;

pub use glance::Glance;

/// Starts of the declared model's fit.
const STARTS: usize = 4;
/// The same where none of those lies on a soil that carries the loads.
const MORE_STARTS: usize = 64;
/// The same of a model with effects that none of the first leads to an explanation with.
const STARTS_OF_EFFECTS: usize = 16;
/// Steps after which a fit to most of the runs from that to all tells whether it is worth its end.
const BRIEFLY: usize = 6;
/// Steps of one that is to be near its end.
const SHORTLY: usize = 10;
/// Times that a fit which ran out of steps may go on.
const CONTINUATIONS: usize = 2;
/// Gain in ln posterior of a step below which a fit has come to its end: far less than what tells anything apart.
const TOLERANCE: f64 = 1e-4;
/// Seed of the places where they lie.
const SEED: u32 = 1;

/// Rows and options that hold the scales of noise and offsets.
#[derive(Debug, Clone)]
pub struct Held {
    /// The rows, their noise scaled.
    pub rows: Vec<Row>,
    /// The options.
    pub options: Options,
}

/// A model that is yet to be fitted, and its effects.
type Extended<'a> = (Specification, CampaignModel<'a>);

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
        let mut options = Options { most_iterations: 40, tolerance: TOLERANCE, ..Options::default() };
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
    pub fn fitted_from_many_starts(&self, specification: Specification) -> Result<Trial<'a>, FitError> {
        let model = CampaignModel::new(self.campaign, self.measurements, &specification);
        let rows = &self.measurements.rows;
        let from = |places: Range<usize>| {
            let starts = scattered_starts(&model, rows, places.end, SEED);
            fit_from_many(&model, rows, &self.without, &starts[places], &self.options)
        };
        let fit = match from(0..STARTS) {
            Err(FitError::NoPrediction) => from(STARTS..MORE_STARTS)?,
            Ok(few) if !specification.effects.is_empty() && self.is_unexplained(&few) => {
                let more = from(STARTS..STARTS_OF_EFFECTS).ok();
                more.filter(|more| more.log_posterior > few.log_posterior).unwrap_or(few)
            }
            few => few?,
        };
        Ok(Trial { specification, model, fit })
    }

    /// Whether a fit leaves more than noise: everywhere, or in how far runs are off.
    pub fn is_unexplained(&self, fit: &Fit) -> bool {
        fit.dispersion > MISFIT || self.measurements.off_by_run(&fit.offset_std).next().is_some()
    }

    /// A model with one more effect: the better of the fit from that without, and of the fit from a soil as it is expected.
    /// What lacks an effect may have bent the soil so far that from there the effect leads nowhere.
    pub fn with_effect(&self, base: &Trial<'a>, effect: &EffectForm) -> Option<Trial<'a>> {
        let extended = self.extended(base, effect);
        let afresh = self.fitted(&extended, &self.afresh(base, &extended.1), &self.measurements.rows, &self.options);
        better(self.near(base, &extended, &self.measurements.rows, &self.options), afresh)
    }

    /// A model with one more effect, from the fit of that without.
    pub fn with_effect_near(&self, base: &Trial<'a>, effect: &EffectForm) -> Option<Trial<'a>> {
        self.near(base, &self.extended(base, effect), &self.measurements.rows, &self.options)
    }

    fn near(&self, base: &Trial<'a>, extended: &Extended<'a>, rows: &[Row], options: &Options) -> Option<Trial<'a>> {
        self.fitted(extended, &base.start_of(&extended.1), rows, options)
    }

    fn extended(&self, base: &Trial<'a>, effect: &EffectForm) -> Extended<'a> {
        let specification = base.specification.with(effect.clone());
        let model = CampaignModel::new(self.campaign, self.measurements, &specification);
        (specification, model)
    }

    /// The soil as it is expected, effects as a model without the last has them, slips and loads as they were read.
    fn afresh(&self, base: &Trial<'a>, model: &CampaignModel<'_>) -> Start {
        let expected: Vec<f64> = model.coordinates().iter().map(|coordinate| coordinate.start).collect();
        let soil = base.model.soil_count();
        Start::at(base.parameters_on(&expected[..soil], model), &self.measurements.rows)
    }

    fn fitted(
        &self,
        (specification, model): &Extended<'a>,
        start: &Start,
        rows: &[Row],
        options: &Options,
    ) -> Option<Trial<'a>> {
        let fit = fit_without(model, rows, &self.without, start, options).ok()?;
        Some(Trial { specification: specification.clone(), model: model.clone(), fit })
    }

    /// A model without one of its effects, from the fit of that with it.
    pub fn without_effect(&self, trial: &Trial<'a>, id: &str) -> Option<Trial<'a>> {
        let mut specification = trial.specification.clone();
        specification.effects.retain(|effect| effect.info.id != id);
        let model = CampaignModel::new(self.campaign, self.measurements, &specification);
        let soil = trial.model.soil_count();
        let kept = |place: usize| place < soil || trial.model.effect_parameters()[place - soil].0 != id;
        let all = trial.fit.parameters.iter().enumerate();
        let parameters = all.filter(|(place, _)| kept(*place)).map(|(_, value)| *value).collect();
        let start = Start { parameters, latents: trial.fit.latents.clone(), scales: None };
        let fit = fit_without(&model, &self.measurements.rows, &self.without, &start, &self.options).ok()?;
        Some(Trial { specification, model, fit })
    }

    /// The model of a trial, fitted to this bench's rows from its parameters: those may be of other rows.
    pub fn fitted_like(&self, other: &Trial<'_>) -> Option<Trial<'a>> {
        let model = CampaignModel::new(self.campaign, self.measurements, &other.specification);
        let start = Start::at(other.fit.parameters.clone(), &self.measurements.rows);
        self.fitted(&(other.specification.clone(), model), &start, &self.measurements.rows, &self.options)
    }

    /// The rows and options with the scales of a fit's noise and offsets held.
    pub fn held(&self, fit: &Fit) -> Held {
        let mut rows = self.measurements.rows.clone();
        for row in &mut rows {
            for (noise, scale) in row.noise.iter_mut().zip(&fit.noise_scale) {
                *noise *= scale;
            }
        }
        let offsets = fit.offset_std.map(|std| if std > 0.0 { OffsetStd::Known(std) } else { OffsetStd::None });
        Held { rows, options: Options { offsets, estimate_noise: [false; CHANNELS], ..self.options.clone() } }
    }

    /// A model fitted anew from the place where one with more parameters came to: the better of that and the fit it had.
    pub fn polish(&self, base: &Trial<'a>, further: &Trial<'a>) -> Option<Trial<'a>> {
        let parameters = further.fit.parameters.get(..base.fit.parameters.len())?.to_vec();
        let polished = self.fitted_from(base, &further.fit.place(parameters), &self.options)?;
        Some(polished).filter(|polished| polished.log_posterior() > base.log_posterior())
    }

    /// A trial whose fit has come to its end, or further on the way there.
    pub fn finished(&self, trial: Trial<'a>) -> Trial<'a> {
        let mut best = trial;
        for _ in 0..CONTINUATIONS {
            if best.fit.converged {
                break;
            }
            match self.refit(&best) {
                Some(next) if next.log_posterior() > best.log_posterior() => best = next,
                _ => break,
            }
        }
        best
    }

    /// A trial fitted anew to this bench's runs.
    pub fn refit(&self, trial: &Trial<'a>) -> Option<Trial<'a>> {
        self.fitted_from(trial, &trial.fit.onward(), &self.options)
    }

    /// The same in the first few steps.
    pub fn refit_briefly(&self, trial: &Trial<'a>) -> Option<Trial<'a>> {
        let options = Options { most_iterations: BRIEFLY, ..self.options.clone() };
        self.fitted_from(trial, &trial.fit.onward(), &options)
    }

    /// What a trial's model says of groups of runs that this bench lacks, fitted to its runs in a few steps from where the trial
    /// lies, which is near; of each in the order asked for.
    pub fn predict_shortly<const N: usize>(&self, trial: &Trial<'a>, groups: [&[usize]; N]) -> [Vec<HeldOutRun>; N] {
        let options = Options { most_iterations: SHORTLY, ..self.options.clone() };
        let (rows, start) = (&self.measurements.rows, trial.fit.onward());
        let fitted = predictor_without(&trial.model, rows, &self.without, &start, &options);
        groups.map(|group| {
            let said = fitted.as_ref().ok().and_then(|fitted| fitted.predict(&trial.model, rows, &options, group).ok());
            said.unwrap_or_else(|| group.iter().map(|run| HeldOutRun::without_answer(*run)).collect())
        })
    }

    /// A trial's model fitted from another start.
    fn fitted_from(&self, trial: &Trial<'a>, start: &Start, options: &Options) -> Option<Trial<'a>> {
        let fit = fit_without(&trial.model, &self.measurements.rows, &self.without, start, options).ok()?;
        Some(Trial { specification: trial.specification.clone(), model: trial.model.clone(), fit })
    }
}

/// Of two fits of a model the one of higher posterior.
fn better<'a>(one: Option<Trial<'a>>, other: Option<Trial<'a>>) -> Option<Trial<'a>> {
    let (Some(one), Some(other)) = (&one, &other) else { return one.or(other) };
    Some(if other.log_posterior() > one.log_posterior() { other.clone() } else { one.clone() })
}
