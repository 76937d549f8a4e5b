//! Whether what listed effects were found for is an error of a sensor that stands in no list.
//!
//! The laws of [`super::sensor_law`] are fitted with the soil as effects are, in place of all effects that were found or of the last of them.
//! Behind a listed effect stands an equation that was expected beforehand, and behind a law of no list the best of as many as are tried: so
//! the odds are taken against it by that number (Bonferroni), beside what tells two listed effects apart.

use rayon::prelude::*;

use super::bench::Bench;
use super::document::Unexplained;
use super::fit::Reading;
use super::forward::{FoundStep, Selected};
use super::gain_chance::Gain;
use super::measurements::{Measurements, column_name};
use super::residual_search::share;
use super::selection::{BEYOND_DOUBT, IN_QUESTION, SIGNIFICANT, TELLS_APART, worth, worth_of_all};
use super::sensor_law::{SensorLaw, channel_of, is_late, sensor_laws};
use super::specification::EffectForm;
use super::trial::Trial;
use super::unseen_runs::{HeldOutGain, held_out};

/// Laws that are fitted to the end, of all that a short look is taken at.
const FITTED: usize = 3;
/// Times the distance at which candidates are in question from which a short look at a law is enough.
const FAR_BEHIND: f64 = 2.0;
/// Standard errors by which what is gained on runs that were not seen must exceed nothing.
const HELD_OUT_ERRORS: f64 = 1.0;

/// A law of a sensor, in place of the last of the effects that were found.
#[derive(Debug, Clone)]
pub struct Rival<'a> {
    /// The model with the effects that stay, and with the law.
    pub trial: Trial<'a>,
    /// The ids of the effects that it stands in place of; none where none was found.
    pub in_place_of: Vec<&'static str>,
    /// How many effects stay.
    pub stay: usize,
    /// Whether it explains the data better than those; else these data do not tell it from them.
    pub takes_place: bool,
    /// The chance of what it gains over the model with the effects that stay, over all laws.
    pub p_value: f64,
}

impl Rival<'_> {
    /// The channel that it reads wrong.
    fn channel(&self) -> Option<Reading> {
        channel_of(self.trial.added()?)
    }

    /// What no listed effect explains beside a model: a channel that follows its own reading. None of a law that takes no effect's place.
    pub fn unexplained(&self, beside: &Trial<'_>) -> Option<Unexplained> {
        let channel = self.channel().filter(|_| self.takes_place)?;
        let name = column_name(channel).to_owned();
        let share_of_variance = share(&beside.fit, &self.trial.fit, channel);
        Some(Unexplained { channel: name.clone(), regressor: name, share_of_variance, p_value: self.p_value })
    }

    /// What a reader should know of it.
    pub fn in_words(&self, measurements: &Measurements) -> Option<String> {
        let channel = column_name(self.channel()?);
        let (place, _) = self.trial.places_of(channel).next()?;
        let law = SensorLaw::of(self.trial.added()?, measurements, place)?;
        let error = law.in_words(self.trial.fit.parameters[place], self.trial.std(place));
        let effects = self.in_place_of.join(" and ");
        let does = if self.in_place_of.len() == 1 { "does" } else { "do" };
        let explains = match (self.takes_place, self.in_place_of.is_empty()) {
            (true, true) => "explains what no effect does".to_owned(),
            (true, false) => format!("explains more than {effects} {does}"),
            (false, _) => format!("explains as much as {effects} {does}: these data do not tell which it is"),
        };
        Some(format!("An error of the sensor of {channel} that stands in no list, {error}, {explains}."))
    }
}

/// The law that takes the place of most of the effects that were found, or else is not told from them; none where there is none.
pub fn rival<'a>(bench: &Bench<'a>, selected: &Selected<'a>) -> Option<Rival<'a>> {
    let found = &selected.found;
    let mut near = None;
    for stay in 0..found.len() {
        match in_place(bench, &found[stay..], selected.model(), stay) {
            Some(rival) if rival.takes_place => return Some(rival),
            other => near = near.or(other),
        }
    }
    near
}

/// The best law on top of a model that lacks nothing of the list. Chance must do less than leaves a doubt: no equation of the list stands behind
/// it, and no effect asks for an explanation. What drifts along runs looks late, so that nothing is called late there.
pub fn alone_on<'a>(bench: &Bench<'a>, base: &Trial<'a>, dispersion: f64) -> Option<Rival<'a>> {
    let laws: Vec<_> = sensor_laws(bench.measurements).into_iter().filter(|law| !is_late(law)).collect();
    let Best { trial, tried } = best(bench, base, &laws, worth_of_all(base))?;
    let p_value = chance(base, &trial, dispersion, tried);
    if p_value > BEYOND_DOUBT || trial.is_out_of_bounds() {
        return None;
    }
    let held_out = HeldOutGain::over(&held_out(bench, base), &held_out(bench, &trial));
    let is_held = held_out.exceeds(HELD_OUT_ERRORS) && held_out.is_shared();
    is_held.then_some(Rival { trial, in_place_of: Vec::new(), stay: 0, takes_place: true, p_value })
}

/// The best law in place of effects, where these are not told from it or it explains more.
fn in_place<'a>(bench: &Bench<'a>, effects: &[FoundStep<'a>], model: &Trial<'a>, stay: usize) -> Option<Rival<'a>> {
    let base = &effects.first()?.step.base;
    let laws = sensor_laws(bench.measurements);
    let far_behind = FAR_BEHIND * IN_QUESTION * base.fit.dispersion.max(1.0);
    let Best { trial, tried } = best(bench, base, &laws, worth_of_all(model) - far_behind)?;
    let dispersion = trial.fit.dispersion.min(model.fit.dispersion).max(1.0);
    let ahead = (worth_of_all(&trial) - worth_of_all(model)) / dispersion - (tried as f64).ln();
    if ahead < -TELLS_APART || trial.is_out_of_bounds() {
        return None;
    }
    let [before, by_effects, by_law] = [base, model, &trial].map(|trial| held_out(bench, trial));
    let [over_none, over_effects] = [&before, &by_effects].map(|other| HeldOutGain::over(other, &by_law));
    let p_value = chance(base, &trial, dispersion, tried);
    let is_earned = p_value < SIGNIFICANT && over_none.exceeds(HELD_OUT_ERRORS) && over_none.is_shared();
    let is_near = over_effects.per_row > -HELD_OUT_ERRORS * over_effects.std;
    let takes_place = ahead > TELLS_APART && over_effects.exceeds(HELD_OUT_ERRORS) && over_effects.is_shared();
    let in_place_of = effects.iter().map(|found| found.winner.id()).collect();
    (is_earned && is_near).then_some(Rival { trial, in_place_of, stay, takes_place, p_value })
}

/// The chance of what the best of so many laws gains over a model without.
fn chance(base: &Trial<'_>, law: &Trial<'_>, dispersion: f64, tried: usize) -> f64 {
    let gain = Gain { rows_per_reading: law.fit.rows_per_reading(), ..Gain::over(base, law, dispersion) };
    gain.chance(law.added_parameters(), tried)
}

/// The law that is worth most on top of a model.
struct Best<'a> {
    trial: Trial<'a>,
    /// How many were tried.
    tried: usize,
}

/// That, of those which after a short look are worth more than the least that is in question.
fn best<'a>(bench: &Bench<'a>, base: &Trial<'a>, laws: &[EffectForm], least: f64) -> Option<Best<'a>> {
    let held = bench.held(&base.fit);
    let mut glances: Vec<_> = laws.par_iter().filter_map(|law| bench.glance(&held, base, law)).collect();
    glances.retain(|glance| worth_of_all(&glance.better) > least);
    glances.sort_by(|a, b| worth(&b.better).total_cmp(&worth(&a.better)));
    glances.truncate(FITTED);
    let fitted = glances.par_iter().filter_map(|glance| Some(bench.finished(bench.pursued(glance)?)));
    let trial = fitted.reduce_with(|a, b| if worth(&b) > worth(&a) { b } else { a })?;
    Some(Best { trial, tried: laws.len() })
}
