//! A law of no list: the simplest formula of a small grammar that explains what no known effect does, on runs that it has not
//! seen. Found, not understood.

use rayon::prelude::*;

use super::bench::Bench;
use super::document::{Estimate, FoundLaw};
use super::fit::{Fit, Reading};
use super::formula::{Group, Term, figure, terms};
use super::formula_groups::{Scale, groups, scale};
use super::gain_chance::Gain;
use super::linearised::{AddedTerms, Linearised, Term as AddedTerm};
use super::measurements::column_name;
use super::residual_search::Structure;
use super::selection::SIGNIFICANT;
use super::term_screen::Screen;
use super::trial::Trial;
use super::unseen_runs::{gains, groups as folds, summed};
use crate::statistics::root_mean_square;

/// Most terms of a law.
const MOST_TERMS: usize = 2;
/// Terms that are fitted, of all that are looked at.
const FITTED: usize = 16;
/// Terms that are judged on held-out runs, of those that are fitted.
const JUDGED: usize = 5;
/// What a symbol must gain in ln likelihood to be worth itself.
const SYMBOL_COST: f64 = 1.0;
/// Difference in held-out ln density below which the simpler of two terms is taken.
const AS_GOOD: f64 = 2.0;
/// Standard errors by which the gain on held-out runs must exceed nothing.
const HELD_OUT_ERRORS: f64 = 1.0;

/// The simplest law of the channel in which structure is left, on top of a trial; gains are measured in units of the
/// `dispersion`. None where no formula beats chance, or none helps on held-out runs.
pub fn law(bench: &Bench<'_>, trial: &Trial<'_>, structure: &Structure, dispersion: f64) -> Option<FoundLaw> {
    let measurements = bench.measurements;
    let linearised = Linearised::about(&trial.model, &trial.fit, &measurements.rows, measurements, &bench.options)?;
    let first: Vec<&str> = structure.columns.iter().map(String::as_str).collect();
    let groups = groups(bench, trial, &linearised, &first);
    let search = Search {
        bench,
        trial,
        terms: terms(&groups),
        groups,
        scale: scale(bench, &linearised, structure.channel),
        folds: folds(measurements.runs.len(), measurements.rows.len()),
        linearised,
        channel: structure.channel,
        dispersion,
    };
    let nothing = search.held_out(search.fitted(Vec::new())?);
    let mut best: Option<Law> = None;
    for _ in 0..MOST_TERMS {
        let Some(next) = search.next(best.as_ref().unwrap_or(&nothing)) else { break };
        best = Some(next);
    }
    Some(search.tell(&nothing, &best?))
}

/// What a search works with.
struct Search<'a, 'b> {
    bench: &'a Bench<'b>,
    trial: &'a Trial<'b>,
    linearised: Linearised<'a>,
    groups: Vec<Group>,
    scale: Scale,
    terms: Vec<Term>,
    folds: Vec<Vec<usize>>,
    channel: Reading,
    dispersion: f64,
}

/// A law, fitted.
struct Law {
    /// Its terms, by their places.
    chosen: Vec<usize>,
    added: AddedTerms,
    /// What the values of each term were divided by.
    sizes: Vec<f64>,
    fit: Fit,
    log_posterior: f64,
    /// ln predictive density of each group of runs by fits without them, once it was asked for.
    held_out: Vec<Option<f64>>,
}

impl Search<'_, '_> {
    /// The law with one more term: the simplest of those that predict held-out runs best; none where no term beats chance.
    fn next(&self, before: &Law) -> Option<Law> {
        let held = self.bench.held(&before.fit);
        let screen = Screen::new(&self.linearised, &before.added, &before.fit, &held)?;
        let promise = |(place, term): (usize, &Term)| {
            let gain = screen.gain(&term.values(&self.groups, &self.scale.values));
            (gain / self.dispersion - self.cost(place), place)
        };
        let new = self.terms.par_iter().enumerate().filter(|(place, _)| !before.chosen.contains(place));
        let mut promising: Vec<(f64, usize)> = new.map(promise).collect();
        promising.sort_by(|a, b| b.0.total_cmp(&a.0));
        let with = |&(_, place): &(f64, usize)| {
            let law = self.fitted(before.chosen.iter().copied().chain([place]).collect())?;
            let ln_posterior = law.log_posterior - before.log_posterior;
            let (dispersion, rows_per_reading) = (self.dispersion, law.fit.rows_per_reading());
            let gain = Gain { before: &before.fit, after: &law.fit, ln_posterior, dispersion, rows_per_reading };
            let likely = gain.chance(1, self.terms.len()) < SIGNIFICANT;
            let worth = gain.in_dispersions() - self.cost(place);
            likely.then_some((worth, law))
        };
        let mut fitted: Vec<(f64, Law)> =
            promising[..promising.len().min(FITTED)].par_iter().filter_map(with).collect();
        fitted.sort_by(|a, b| b.0.total_cmp(&a.0));
        fitted.truncate(JUDGED);
        let judge = |(_, law): (f64, Law)| {
            let law = self.held_out(law);
            let (gain, std) = held_out_gain(before, &law)?;
            (gain > HELD_OUT_ERRORS * std).then_some((gain / self.dispersion, law))
        };
        let judged: Vec<(f64, Law)> = fitted.into_par_iter().filter_map(judge).collect();
        let most = judged.iter().map(|(gain, _)| *gain).fold(f64::NEG_INFINITY, f64::max);
        let symbols = |law: &Law| law.chosen.last().map_or(0, |place| self.terms[*place].symbols());
        let as_good = judged.into_iter().filter(|(gain, _)| *gain > most - AS_GOOD);
        as_good.min_by(|a, b| symbols(&a.1).cmp(&symbols(&b.1)).then(b.0.total_cmp(&a.0))).map(|(_, law)| law)
    }

    fn cost(&self, place: usize) -> f64 {
        SYMBOL_COST * self.terms[place].symbols() as f64
    }

    /// The law of some terms, fitted; none where a term has no size or there is no fit.
    fn fitted(&self, chosen: Vec<usize>) -> Option<Law> {
        let mut added = AddedTerms { channel: self.channel, terms: Vec::new() };
        let mut sizes = Vec::new();
        for place in &chosen {
            let values = self.terms[*place].values(&self.groups, &self.scale.values);
            let size = root_mean_square(values.iter().copied());
            let unit = self.unit();
            if !(size.is_finite() && size > 0.0 && unit > 0.0) {
                return None;
            }
            // A coefficient of one is then as much as the noise.
            added.terms.push(AddedTerm::steady(values.iter().map(|value| value * unit / size).collect()));
            sizes.push(size / unit);
        }
        let fit = self.linearised.fit_with(&added).ok()?;
        let log_posterior = fit.log_likelihood + self.trial.log_prior(&fit.parameters);
        Some(Law { chosen, added, sizes, fit, log_posterior, held_out: Vec::new() })
    }

    /// The same, tried on held-out runs.
    fn held_out(&self, law: Law) -> Law {
        let model = self.linearised.with(&law.added);
        let predict = |runs: &Vec<usize>| law.fit.leave_out(&model, runs).ok()?.log_score();
        let held_out = self.folds.par_iter().map(predict).collect();
        Law { held_out, ..law }
    }

    /// A size of the channel's noise.
    fn unit(&self) -> f64 {
        self.bench.measurements.noise[self.channel.index()].std
    }

    fn tell(&self, nothing: &Law, law: &Law) -> FoundLaw {
        let channel = column_name(self.channel);
        let mut formula = format!("{channel} +=");
        for (number, place) in law.chosen.iter().enumerate() {
            let value = self.coefficient(law, number).value;
            let sign = match (number, value < 0.0) {
                (0, false) => " ",
                (0, true) => " -",
                (_, false) => " + ",
                (_, true) => " - ",
            };
            let term = self.terms[*place].written(&self.groups);
            formula += &format!("{sign}{} {} {term}", figure(value.abs()), self.scale.symbol);
        }
        let gain = held_out_gain(nothing, law).map_or(0.0, |(gain, _)| gain);
        let rows = self.bench.measurements.rows.len().max(1);
        FoundLaw {
            channel: channel.to_owned(),
            formula,
            coefficient: self.coefficient(law, 0),
            gain_per_row: gain / rows as f64,
        }
    }

    /// The dimensionless coefficient of a law's term.
    fn coefficient(&self, law: &Law, number: usize) -> Estimate {
        let place = law.fit.parameters.len() - law.sizes.len() + number;
        let variance = law.fit.covariance[(place, place)].max(0.0) * law.fit.dispersion.max(1.0);
        let size = law.sizes[number];
        Estimate { value: law.fit.parameters[place] / size, std: variance.sqrt() / size }
    }
}

/// Gain in held-out ln density, and its standard deviation over groups of runs. Groups of which the law before says nothing
/// count for nothing; none where only the law after has no answer.
fn held_out_gain(before: &Law, after: &Law) -> Option<(f64, f64)> {
    gains(&before.held_out, &after.held_out).map(|gains| summed(&gains))
}

#[cfg(test)]
mod tests;
