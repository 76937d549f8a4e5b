//! A model with a fit of it to a campaign, and what the fit says of its parameters.

use kapvik_firmware::terramechanics::effects::Role;

use super::campaign_model::CampaignModel;
use super::fit::{Coordinate, Fit, Model, Start};
use super::specification::{EffectForm, Specification};
use crate::data::campaign::is_reference;

/// Share of the variance of its bounds beyond which nothing is known of a parameter.
const SILENT: f64 = 0.9;
/// Standard deviations of each parameter within which two fits lie in one place.
const NEAR: f64 = 0.5;
/// Standard deviations beyond a bound from which a size that is held on it is not one that the data support.
const BEYOND_BOUND: f64 = 2.0;

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

impl Trial<'_> {
    /// Whether another fit of the model lies where this one does, as far as its data tell.
    pub(super) fn is_near(&self, other: &Self) -> bool {
        let places = self.fit.parameters.iter().zip(&other.fit.parameters).enumerate();
        places
            .into_iter()
            .all(|(p, (one, other))| (one - other).abs() <= NEAR * self.fit.covariance[(p, p)].max(0.0).sqrt())
    }

    /// Whether the data say nothing of a parameter where the fit is: its spread is that of its bounds.
    pub(super) fn is_silent_of(&self, place: usize) -> bool {
        let width = self.model.coordinates()[place].high - self.model.coordinates()[place].low;
        self.fit.covariance[(place, place)] > SILENT * width * width / 12.0
    }

    /// Where a model with more parameters at the end starts from this one's fit.
    pub(super) fn start_of(&self, model: &CampaignModel<'_>) -> Start {
        self.fit.place(self.parameters_on(&self.fit.parameters[..self.model.soil_count()], model))
    }

    /// Parameters of a model with more effects at the end: on some soil, effects as this fit has them, the others as none.
    pub(super) fn parameters_on(&self, soil: &[f64], model: &CampaignModel<'_>) -> Vec<f64> {
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
        let penalty = |(coordinate, value): (&Coordinate, &f64)| coordinate.penalty(*value);
        -self.model.coordinates().iter().zip(parameters).map(penalty).sum::<f64>()
    }

    /// Whether its last effect is pushed out of its range. A size that the data push out of it, by more than they leave open, is
    /// not one that they support; nor is a shape that they push out of it at all, for the form then stands for another law. Of a
    /// shape that may be absent, and is, the data say just that.
    pub fn is_out_of_bounds(&self) -> bool {
        let Some(effect) = self.added() else { return false };
        self.places_of(effect.info.id).any(|(place, name)| {
            let info = effect.info.parameter(name);
            let is_size = info.is_some_and(|info| info.role == Role::Size);
            let neutral = info.map(|info| info.neutral);
            let beyond = self.fit.beyond_bound(place);
            if is_size { beyond > BEYOND_BOUND } else { beyond > 0.0 && neutral != Some(self.fit.parameters[place]) }
        })
    }

    /// Whether what the last effect refers to, as the temperature at which it does nothing, lies at an end of its range: what is left of its
    /// law there is a constant or a line, and of another effect.
    pub fn has_no_reference(&self) -> bool {
        let Some(effect) = self.added() else { return false };
        self.places_of(effect.info.id).any(|(place, name)| is_reference(name) && self.fit.beyond_bound(place) > 0.0)
    }

    /// Whether all parameters of the last effect lie so few standard deviations from doing nothing.
    pub fn may_be_neutral(&self, errors: f64) -> bool {
        let Some(effect) = self.added() else { return true };
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

    /// Its last effect.
    pub fn added(&self) -> Option<&EffectForm> {
        self.specification.effects.last()
    }

    /// The id of that; nothing without one.
    pub fn added_id(&self) -> &'static str {
        self.added().map_or("", |effect| effect.info.id)
    }

    /// Parameters that the last effect frees.
    pub fn added_parameters(&self) -> usize {
        self.added().map_or(0, |effect| effect.form.free.len())
    }
}
