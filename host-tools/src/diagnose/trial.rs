//! A model tried on a campaign: fitted, and judged on runs that it has not seen.

use super::campaign_model::CampaignModel;
use super::fit::{
    CHANNELS, Coordinate, Fit, FitError, HeldOutRun, Model, OffsetStd, Options, Reading, Row, Start, fit_from_many,
    fit_without, predictor_without, scattered_starts,
};
use super::measurements::Measurements;
use super::selection::MISFIT;
use super::sizes::sizes;
use super::specification::{EffectForm, Specification};
use crate::data::campaign::Campaign;

/// Starts of the declared model's fit.
const STARTS: usize = 4;
/// The same where none of those lies on a soil that carries the loads.
const MORE_STARTS: usize = 64;
/// Steps of a short look at a candidate.
const GLANCE: usize = 5;
/// The same from a soil as it is expected, which is further off.
const AFRESH: usize = 8;
/// The same where the model without the candidate leaves the data unexplained: its soil is bent the further.
const AFRESH_OF_A_MISFIT: usize = 24;
/// Share of the variance of its bounds beyond which nothing is known of a parameter.
const SILENT: f64 = 0.9;
/// Steps after which a fit to most of the runs from that to all tells whether it is worth its end.
const BRIEFLY: usize = 6;
/// Steps of one that is to be near its end.
const SHORTLY: usize = 10;
/// Times that a fit which ran out of steps may go on.
const CONTINUATIONS: usize = 2;
/// Gain in ln posterior of a step below which a fit has come to its end: far less than what tells anything apart.
const TOLERANCE: f64 = 1e-4;
/// Standard deviations of each parameter within which two fits lie in one place.
const NEAR: f64 = 0.5;
/// Standard deviations beyond a bound from which a size that is held on it is not one that the data support.
const BEYOND_BOUND: f64 = 2.0;
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

/// What a short look at a model with one more effect came to from one start and from the other.
#[derive(Debug, Clone)]
pub struct Glance<'a> {
    /// Where the posterior is higher.
    pub better: Trial<'a>,
    other: Option<Trial<'a>>,
}

impl<'a> Glance<'a> {
    /// From one start.
    pub fn of(trial: Trial<'a>) -> Self {
        Self { better: trial, other: None }
    }

    /// With one from another start; of the three the better two stay.
    fn beside(self, another: Trial<'a>) -> Self {
        let Glance { better, other } = self;
        if another.log_posterior() > better.log_posterior() {
            return Glance { better: another, other: Some(better) };
        }
        let is_next = other.as_ref().is_none_or(|other| another.log_posterior() > other.log_posterior());
        Glance { better, other: if is_next { Some(another) } else { other } }
    }
}

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
    pub fn from_many_starts(&self, specification: Specification) -> Result<Trial<'a>, FitError> {
        let model = CampaignModel::new(self.campaign, self.measurements, &specification);
        let from = |count: usize| {
            let starts = scattered_starts(&model, &self.measurements.rows, count, SEED);
            fit_from_many(&model, &self.measurements.rows, &starts, &self.options)
        };
        let fits = match from(STARTS) {
            Err(FitError::NoPrediction) => from(MORE_STARTS),
            fits => fits,
        };
        let fit = fits?.best;
        Ok(Trial { specification, model, fit })
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

    /// A short look at a model with one more effect: a few steps as of [`Bench::glance_near`], and from a soil as it is expected
    /// with scales of its own; where both end where the effect does nothing, one more.
    pub fn glance(&self, held: &Held, base: &Trial<'a>, effect: &EffectForm) -> Option<Glance<'a>> {
        let extended = self.extended(base, effect);
        let most_iterations = if base.fit.dispersion > MISFIT { AFRESH_OF_A_MISFIT } else { AFRESH };
        let options = Options { most_iterations, ..self.options.clone() };
        let afresh = self.fitted(&extended, &self.afresh(base, &extended.1), &self.measurements.rows, &options);
        let glance = match (self.few_steps(held, base, &extended), afresh) {
            (Some(near), Some(afresh)) => Glance { better: near, other: None }.beside(afresh),
            (near, afresh) => Glance { better: near.or(afresh)?, other: None },
        };
        let is_silent = glance.better.is_silent_of(base.fit.parameters.len());
        let roused = if is_silent { self.roused(held, base, &extended, &options) } else { None };
        Some(match roused {
            Some(roused) => glance.beside(roused),
            None => glance,
        })
    }

    /// A look from the best of an effect's sizes on a soil as it is expected. Past its onset an effect does nothing, nor does one
    /// without size in whatever shape, and no slope leads back there.
    fn roused(&self, held: &Held, base: &Trial<'a>, extended: &Extended<'a>, options: &Options) -> Option<Trial<'a>> {
        let place = base.fit.parameters.len();
        let expected = self.afresh(base, &extended.1);
        let no_step = Options { most_iterations: 0, ..held.options.clone() };
        let tried = sizes(&extended.1.coordinates()[place..]).into_iter().filter_map(|own| {
            let mut start = expected.clone();
            start.parameters[place..][..own.len()].copy_from_slice(&own);
            let there = self.fitted(extended, &start, &held.rows, &no_step)?;
            Some((there.log_posterior(), start))
        });
        let (_, best) = tried.max_by(|a, b| a.0.total_cmp(&b.0))?;
        self.fitted(extended, &best, &self.measurements.rows, options)
    }

    /// A short look once more, from the soil of a model that another effect was added to.
    pub fn glance_beside(&self, glance: Glance<'a>, base: &Trial<'a>, leader: &Trial<'a>) -> Glance<'a> {
        let options = Options { most_iterations: AFRESH, ..self.options.clone() };
        let soil = &leader.fit.parameters[..leader.model.soil_count()];
        let start = leader.fit.place(base.parameters_on(soil, &glance.better.model));
        match self.fitted_from(&glance.better, &start, &options) {
            Some(again) => glance.beside(again),
            None => glance,
        }
    }

    /// The fit that a short look leads to: on from both of its ends, unless they lie in one place.
    pub fn pursued(&self, glance: &Glance<'a>) -> Option<Trial<'a>> {
        let Glance { better: one, other } = glance;
        let other = other.as_ref().filter(|other| !one.is_near(other)).and_then(|other| self.refit(other));
        better(self.refit(one), other)
    }

    /// A few steps from the model without the effect, with the scales of noise and offsets that this one has.
    pub fn glance_near(&self, held: &Held, base: &Trial<'a>, effect: &EffectForm) -> Option<Trial<'a>> {
        self.few_steps(held, base, &self.extended(base, effect))
    }

    fn few_steps(&self, held: &Held, base: &Trial<'a>, extended: &Extended<'a>) -> Option<Trial<'a>> {
        let options = Options { most_iterations: GLANCE, ..held.options.clone() };
        self.near(base, extended, &held.rows, &options)
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

impl Trial<'_> {
    /// Whether another fit of the model lies where this one does, as far as its data tell.
    fn is_near(&self, other: &Self) -> bool {
        let places = self.fit.parameters.iter().zip(&other.fit.parameters).enumerate();
        places
            .into_iter()
            .all(|(p, (one, other))| (one - other).abs() <= NEAR * self.fit.covariance[(p, p)].max(0.0).sqrt())
    }

    /// Whether the data say nothing of a parameter where the fit is: its spread is that of its bounds.
    fn is_silent_of(&self, place: usize) -> bool {
        let width = self.model.coordinates()[place].high - self.model.coordinates()[place].low;
        self.fit.covariance[(place, place)] > SILENT * width * width / 12.0
    }

    /// Where a model with more parameters at the end starts from this one's fit.
    fn start_of(&self, model: &CampaignModel<'_>) -> Start {
        self.fit.place(self.parameters_on(&self.fit.parameters[..self.model.soil_count()], model))
    }

    /// Parameters of a model with more effects at the end: on some soil, effects as this fit has them, the others as none.
    fn parameters_on(&self, soil: &[f64], model: &CampaignModel<'_>) -> Vec<f64> {
        let starts = model.coordinates().iter().map(|coordinate| coordinate.start);
        let effects = &self.fit.parameters[soil.len()..];
        let known = soil.iter().chain(effects).copied();
        known.chain(starts.skip(self.fit.parameters.len())).collect()
    }

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

    /// Whether its last effect is pushed out of its range. A size that the data push out of it, by more than they leave open, is
    /// not one that they support; nor is a shape that they push out of it at all, for the form then stands for another law. Of a
    /// shape that may be absent, and is, the data say just that.
    pub fn is_out_of_bounds(&self) -> bool {
        let Some(effect) = self.specification.effects.last() else { return false };
        self.places_of(effect.info.id).any(|(place, name)| {
            let is_size = effect.form.free.first() == Some(&name);
            let neutral = effect.info.parameter(name).map(|info| info.neutral);
            let beyond = self.fit.beyond_bound(place);
            if is_size { beyond > BEYOND_BOUND } else { beyond > 0.0 && neutral != Some(self.fit.parameters[place]) }
        })
    }

    /// Whether all parameters of the last effect lie so few standard deviations from doing nothing.
    pub fn may_be_neutral(&self, errors: f64) -> bool {
        let Some(effect) = self.specification.effects.last() else { return true };
        self.places_of(effect.info.id).all(|(place, name)| {
            let neutral = effect.info.parameter(name).map_or(f64::NAN, |info| info.neutral);
            (self.fit.parameters[place] - neutral).abs() <= errors * self.std(place)
        })
    }

    /// Places and names of the parameters that an effect frees.
    pub fn places_of(&self, id: &str) -> impl Iterator<Item = (usize, &'static str)> {
        let freed = self.model.effect_parameters().iter().enumerate().filter(move |(_, (effect, _))| *effect == id);
        freed.map(|(place, (_, name))| (self.model.soil_count() + place, *name))
    }

    /// Standard deviation of the parameter at a place, widened by what the model misses the data by.
    pub fn std(&self, place: usize) -> f64 {
        (self.fit.covariance[(place, place)].max(0.0) * self.fit.dispersion.max(1.0)).sqrt()
    }

    /// Parameters that its effects free.
    pub fn effect_parameters(&self) -> usize {
        self.model.effect_parameters().len()
    }

    /// Parameters that the last effect frees.
    pub fn added_parameters(&self) -> usize {
        self.specification.effects.last().map_or(0, |effect| effect.form.free.len())
    }
}
