//! Structure in a residual: whether a channel follows a column, known or unknown, more than chance and a refit explain.

use rayon::prelude::*;

use super::fit::{Fit, Reading};
use super::linearised::{AddedTerms, Linearised};
use super::regressors::{Regressor, columns, products};
use super::selection::{PARAMETER_COST, family_chance, gain_over};
use super::trial::{Bench, Trial};

/// A channel's dependence on a column.
#[derive(Debug, Clone)]
pub struct Structure {
    /// The channel.
    pub channel: Reading,
    /// The column, or the product of two.
    pub regressor: String,
    /// Greatest power of it.
    degree: usize,
    /// Gain in ln likelihood in units of the dispersion, less the cost of the terms' coefficients.
    pub score: f64,
    /// Share of the channel's residual that follows it.
    pub share_of_variance: f64,
    /// The chance of such a gain, over all channels and columns that were tried.
    pub p_value: f64,
    /// Gain in log predictive density on runs that the fit did not see, nats a row: of the best few, none of the others.
    pub gain_per_row: Option<f64>,
}

impl Structure {
    /// Whether chance does not explain it.
    pub fn is_significant(&self) -> bool {
        self.p_value < SIGNIFICANT_STRUCTURE && self.gain_per_row.is_some_and(|gain| gain > 0.0)
    }
}

/// The chance, over all channels and columns, below which a dependence is taken for one. Less than for an effect: behind an
/// effect stands an equation that was written before the data.
const SIGNIFICANT_STRUCTURE: f64 = 0.001;
/// The best few, which are judged on runs that the fit did not see.
const JUDGED: usize = 8;
/// Powers of one column that are tried: a line, and a curve that may turn twice.
const DEGREES: [usize; 2] = [1, 3];

/// Every channel against every column and every product of two, refitted with the model's parameters; the best first. One
/// entry a channel and column.
pub fn search(bench: &Bench<'_>, trial: &Trial<'_>, dispersion: f64) -> Vec<Structure> {
    let measurements = bench.measurements;
    let held = bench.held(&trial.fit);
    let about = Linearised::about(&trial.model, &trial.fit, &held.rows, &measurements.rows_of_run, &held.options);
    let Some(linearised) = about else { return Vec::new() };
    let Ok(nothing) = linearised.fit_with(&AddedTerms { channel: Reading::Sinkage, terms: Vec::new() }) else {
        return Vec::new();
    };
    let columns = columns(bench.campaign, measurements);
    let products = products(&columns);
    let channels = Reading::JUDGED.into_iter().filter(|channel| measurements.has(*channel));
    let singles = columns.iter().flat_map(|column| DEGREES.map(|degree| (column, degree)));
    let all: Vec<_> = singles.chain(products.iter().map(|product| (product, 1))).collect();
    let tries: Vec<_> = channels
        .flat_map(|channel| all.iter().map(move |(regressor, degree)| (channel, *regressor, *degree)))
        .filter(|(channel, regressor, _)| !regressor.contains(*channel))
        .collect();
    let examine = |&(channel, regressor, degree): &(Reading, &Regressor, usize)| {
        let added = AddedTerms { channel, terms: powers(regressor, degree) };
        let terms = added.terms.len();
        let fit = linearised.fit_with(&added).ok()?;
        let prior = trial.log_prior(&fit.parameters) - trial.log_prior(&nothing.parameters);
        let gain = (fit.log_likelihood - nothing.log_likelihood + prior) / dispersion;
        Some(Structure {
            channel,
            regressor: regressor.name.clone(),
            degree,
            score: gain - PARAMETER_COST * terms as f64,
            share_of_variance: share(&nothing, &fit, channel),
            p_value: family_chance(gain, terms, tries.len()),
            gain_per_row: None,
        })
    };
    let mut found: Vec<_> = tries.par_iter().filter_map(examine).collect();
    found.sort_by(|a, b| b.score.total_cmp(&a.score));
    let mut seen = Vec::new();
    found.retain(|structure| {
        let key = (structure.channel, structure.regressor.clone());
        let new = !seen.contains(&key);
        seen.push(key);
        new
    });
    let runs = measurements.runs.len();
    let before = linearised.held_out(&AddedTerms { channel: Reading::Sinkage, terms: Vec::new() }, runs);
    let judge = |structure: &mut Structure| {
        let regressor = columns.iter().chain(&products).find(|regressor| regressor.name == structure.regressor)?;
        let after = linearised
            .held_out(&AddedTerms { channel: structure.channel, terms: powers(regressor, structure.degree) }, runs)?;
        structure.gain_per_row = Some(gain_over(before.as_ref()?, &after).0);
        Some(())
    };
    found.par_iter_mut().take(JUDGED).for_each(|structure| {
        judge(structure);
    });
    found
}

/// The terms of a dependence that was found.
pub fn terms_of(bench: &Bench<'_>, structure: &Structure) -> Option<AddedTerms> {
    let columns = columns(bench.campaign, bench.measurements);
    let all = products(&columns).into_iter().chain(columns);
    let regressor = all.into_iter().find(|regressor| regressor.name == structure.regressor)?;
    Some(AddedTerms { channel: structure.channel, terms: powers(&regressor, structure.degree) })
}

/// A constant, what a product is made of, and the powers: a column's effect seldom vanishes at the column's mean.
fn powers(regressor: &Regressor, degree: usize) -> Vec<Vec<f64>> {
    let constant = vec![1.0; regressor.values.len()];
    let power = |power: i32| regressor.values.iter().map(|value| value.clamp(-4.0, 4.0).powi(power)).collect();
    std::iter::once(constant).chain(regressor.factors.iter().cloned()).chain((1..=degree as i32).map(power)).collect()
}

/// Share of the squares of a channel's standardised residual that is gone.
fn share(before: &Fit, after: &Fit, channel: Reading) -> f64 {
    let squares = |fit: &Fit| -> f64 {
        fit.standardised.iter().filter_map(|row| row[channel.index()]).map(|value| value.powi(2)).sum()
    };
    (1.0 - squares(after) / squares(before).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
}
