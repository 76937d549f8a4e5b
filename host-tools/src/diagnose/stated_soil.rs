//! Numbers of `[soil]` that may be wrong: what the data make of them, and whether that explains what effects were found for.

use rayon::prelude::*;

use crate::data::campaign::{Campaign, Knowledge};
use crate::digits::significant;

use super::bench::Bench;
use super::campaign_model::CampaignModel;
use super::fit::{Coordinate, Model, fit_without};
use super::forward::Selected;
use super::selection::{PARAMETER_COST, TELLS_APART};
use super::soil_coordinates::SoilParameter;
use super::trial::Trial;

/// Standard deviations by which what data say lies beside what is stated to be at odds with it.
const AT_ODDS: f64 = 3.0;
/// Digits of a standard deviation, and of a value, as they are told.
const DIGITS: [usize; 2] = [2, 4];

/// What is said of each number that is at odds with the data where the declared model is left it open, and then explains as much as all effects
/// that were found, or more.
pub fn in_place_of_effects(bench: &Bench<'_>, selected: &Selected<'_>) -> Vec<String> {
    if selected.found.is_empty() {
        return Vec::new();
    }
    let ids: Vec<_> = selected.found.iter().map(|found| found.winner.id()).collect();
    let (base, model) = (&selected.base, selected.model());
    let gained = |trial: &Trial<'_>, freed: usize| {
        (trial.log_posterior() - base.log_posterior()) / selected.dispersion() - PARAMETER_COST * freed as f64
    };
    let by_effects = gained(model, model.effect_parameters() - base.effect_parameters());
    let said = |(parameter, stated): (SoilParameter, Stated)| {
        let left_open = with_open(bench, base, parameter)?;
        let found = found(&left_open, parameter)?;
        let by_number = gained(&left_open, 1);
        let is_as_much = by_number > by_effects - TELLS_APART;
        (is_as_much && stated.is_at_odds(found.value, found.std)).then(|| {
            let more = if by_number > by_effects + TELLS_APART { "more than" } else { "as much as" };
            let does = if ids.len() == 1 { "does" } else { "do" };
            format!(
                "{} in [soil] may be wrong instead: the data alone say {} where {} is stated, and with that the declared model explains \
                 {more} {} {does}.",
                parameter.key(),
                found.in_words(),
                stated.in_words(),
                ids.join(" and ")
            )
        })
    };
    all_stated(bench.campaign).into_par_iter().filter_map(said).collect()
}

/// What is said of the numbers that a fit came to far from where they are stated to be.
pub fn far_from_stated(campaign: &Campaign, trial: &Trial<'_>) -> Vec<String> {
    let said = |(parameter, stated): (SoilParameter, Stated)| {
        let found = found(trial, parameter)?;
        is_far(&stated, found.value).then(|| {
            format!(
                "{} in [soil] is stated to be {}, and the fit comes to {}: that number is wrong, or a law is missing.",
                parameter.key(),
                stated.in_words(),
                significant(found.value, DIGITS[1])
            )
        })
    };
    all_stated(campaign).into_iter().filter_map(said).collect()
}

/// Whether a fit came that far from what is stated of a parameter.
pub fn is_far_from_stated(campaign: &Campaign, trial: &Trial<'_>, parameter: SoilParameter) -> bool {
    let stated = all_stated(campaign).into_iter().find(|(other, _)| *other == parameter);
    let found = found(trial, parameter);
    stated.zip(found).is_some_and(|((_, stated), found)| is_far(&stated, found.value))
}

fn is_far(stated: &Stated, value: f64) -> bool {
    stated.std > 0.0 && stated.is_at_odds(value, 0.0)
}

/// A number with one standard deviation, in the unit of `[soil]`.
#[derive(Debug, Clone, Copy)]
struct Stated {
    value: f64,
    std: f64,
}

impl Stated {
    fn is_at_odds(&self, value: f64, std: f64) -> bool {
        (value - self.value).abs() > AT_ODDS * self.std.hypot(std)
    }

    fn in_words(&self) -> String {
        let [of_std, of_value] = DIGITS;
        match self.std {
            std if std > 0.0 => format!("{} ± {}", significant(self.value, of_value), significant(std, of_std)),
            _ => significant(self.value, of_value).to_string(),
        }
    }
}

/// The numbers that a campaign states, exactly or give or take something.
fn all_stated(campaign: &Campaign) -> Vec<(SoilParameter, Stated)> {
    let stated = |parameter: SoilParameter| match parameter.stated(campaign)? {
        Knowledge::Value { value, std } => Some((parameter, Stated { value, std })),
        Knowledge::Between { .. } => None,
    };
    SoilParameter::ALL.into_iter().filter_map(stated).collect()
}

/// What a fit says of a parameter that is free in it.
fn found(trial: &Trial<'_>, parameter: SoilParameter) -> Option<Stated> {
    let place = trial.model.soil_parameters().iter().position(|free| *free == parameter)?;
    let value = parameter.value(trial.fit.parameters[place]);
    let std = trial.std(place) * if parameter.is_logarithmic() { value } else { 1.0 };
    Some(Stated { value, std })
}

/// A model fitted anew from where it came to, with a number that is stated left open.
fn with_open<'a>(bench: &Bench<'a>, base: &Trial<'a>, parameter: SoilParameter) -> Option<Trial<'a>> {
    let mut campaign = bench.campaign.clone();
    parameter.forget(&mut campaign.ground);
    let model = CampaignModel::new(&campaign, bench.measurements, &base.specification);
    let known = base.model.coordinates().iter().zip(&base.fit.parameters);
    let soil = base.model.soil(&base.fit.parameters);
    let start = |coordinate: &Coordinate| {
        let here = known.clone().find(|(other, _)| other.name == coordinate.name).map(|(_, value)| *value);
        let stated = || parameter.coordinate(*parameter.place(&mut soil.clone()));
        here.unwrap_or_else(stated).clamp(coordinate.low, coordinate.high)
    };
    let start = base.fit.place(model.coordinates().iter().map(start).collect());
    let fit = fit_without(&model, &bench.measurements.rows, &bench.without, &start, &bench.options).ok()?;
    Some(bench.finished(Trial { specification: base.specification.clone(), model, fit }))
}
