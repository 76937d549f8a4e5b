//! Short looks at a model with one more effect, from several starts, and the fit that they lead to.

use super::{Bench, Extended, Held, better};
use crate::diagnose::fit::{Model, Options};
use crate::diagnose::selection::MISFIT;
use crate::diagnose::sizes::sizes;
use crate::diagnose::specification::EffectForm;
use crate::diagnose::trial::Trial;

/// Steps of a short look at a candidate.
const GLANCE: usize = 5;
/// The same from a soil as it is expected, which is further off.
const AFRESH: usize = 8;
/// The same where the model without the candidate leaves the data unexplained: its soil is bent the further.
const AFRESH_OF_A_MISFIT: usize = 24;

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

impl<'a> Bench<'a> {
    /// A short look at a model with one more effect: a few steps as of [`Bench::glance_near`], and from a soil as it is expected
    /// with scales of its own; one more where both end where the effect does nothing, or where an effect that has a shape leaves the
    /// data unexplained: from the wrong side of a shape no slope may lead to the right one.
    pub fn glance(&self, held: &Held, base: &Trial<'a>, effect: &EffectForm) -> Option<Glance<'a>> {
        let extended = self.extended(base, effect);
        let most_iterations = if base.fit.dispersion > MISFIT { AFRESH_OF_A_MISFIT } else { AFRESH };
        let options = Options { most_iterations, ..self.options.clone() };
        let afresh = self.fitted(&extended, &self.afresh(base, &extended.1), &self.measurements.rows, &options);
        let glance = match (self.few_steps(held, base, &extended), afresh) {
            (Some(near), Some(afresh)) => Glance { better: near, other: None }.beside(afresh),
            (near, afresh) => Glance { better: near.or(afresh)?, other: None },
        };
        let known = base.fit.parameters.len();
        let has_shape = extended.1.coordinates().len() > known + 1;
        let is_lost = (has_shape && self.is_unexplained(&glance.better.fit)) || glance.better.is_silent_of(known);
        let far = Options { most_iterations: AFRESH_OF_A_MISFIT, ..options };
        let roused = if is_lost { self.roused(held, base, &extended, &far) } else { None };
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
}
