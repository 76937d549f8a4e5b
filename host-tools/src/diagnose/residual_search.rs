//! Structure in a residual: whether a channel follows a column, known or unknown, more than chance and a refit explain.

use rayon::prelude::*;

use super::fit::{Fit, Reading};
use super::linearised::{AddedTerms, Linearised};
use super::regressors::{Regressor, columns, products};
use super::selection::{PARAMETER_COST, SIGNIFICANT, family_chance};
use super::trial::{Bench, Trial};

/// A channel's dependence on a column.
#[derive(Debug, Clone)]
pub struct Structure {
    /// The channel.
    pub channel: Reading,
    /// The column, or the product of two.
    pub regressor: String,
    /// Gain in ln likelihood in units of the dispersion, less the cost of the terms' coefficients.
    pub score: f64,
    /// Share of the channel's residual that follows it.
    pub share_of_variance: f64,
    /// The chance of such a gain, over all channels and columns that were tried.
    pub p_value: f64,
}

impl Structure {
    /// Whether chance does not explain it.
    pub fn is_significant(&self) -> bool {
        self.p_value < SIGNIFICANT
    }
}

/// Powers of one column that are tried: a line, and a curve that may turn twice.
const DEGREES: [usize; 2] = [1, 3];

/// Every channel against every column and every product of two, refitted with the model's parameters; the best first. One
/// entry a channel and column.
pub fn search(bench: &Bench<'_>, trial: &Trial<'_>, dispersion: f64) -> Vec<Structure> {
    let measurements = bench.measurements;
    let about =
        Linearised::about(&trial.model, &trial.fit, &measurements.rows, &measurements.rows_of_run, &bench.options);
    let Some(linearised) = about else { return Vec::new() };
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
        let fit = linearised.fit_with(&added).ok()?;
        let gain = (fit.log_likelihood - trial.fit.log_likelihood + prior_change(trial, &fit)) / dispersion;
        Some(Structure {
            channel,
            regressor: regressor.name.clone(),
            score: gain - PARAMETER_COST * degree as f64,
            share_of_variance: share(&trial.fit, &fit, channel),
            p_value: family_chance(gain, degree, tries.len()),
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
    found
}

fn powers(regressor: &Regressor, degree: usize) -> Vec<Vec<f64>> {
    (1..=degree as i32)
        .map(|power| regressor.values.iter().map(|value| value.clamp(-4.0, 4.0).powi(power)).collect())
        .collect()
}

/// What the Gaussian priors gain as the parameters move.
fn prior_change(trial: &Trial<'_>, fit: &Fit) -> f64 {
    trial.log_prior(&fit.parameters) - trial.log_prior(&trial.fit.parameters)
}

/// Share of the squares of a channel's standardised residual that is gone.
fn share(before: &Fit, after: &Fit, channel: Reading) -> f64 {
    let squares = |fit: &Fit| -> f64 {
        let scale = fit.noise_scale[channel.index()];
        fit.standardised.iter().filter_map(|row| row[channel.index()]).map(|value| (scale * value).powi(2)).sum()
    };
    (1.0 - squares(after) / squares(before).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
}
