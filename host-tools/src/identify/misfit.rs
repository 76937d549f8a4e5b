//! Runs that no soil explains: what is identified of them stands for something that the model lacks.
//!
//! Every method of identification takes the model for true. The soil of the greatest posterior probability leaves residuals that are as large
//! as the noise, if it is; where they are far larger, the soil has been bent to make up for another law, and is no soil's, by whichever method
//! and however narrow.

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::data::campaign::{Campaign, Channel};

use super::method::{Fit, Method, answer};
use super::on_curve::evidence;
use super::run_states::run_states;
use super::sensor_noise::{NoiseSource, SensorNoise};

/// The chance below which residuals are no noise.
const SIGNIFICANT: f64 = 1e-4;
/// Where a noise was only guessed a misfit may be the guess's, but not one by so much: all noise would have to be five times as large.
const BEYOND_GUESSES: f64 = 25.0;

/// Why runs are explained by no soil, by their names.
pub fn misfits(campaign: &Campaign, noise: &SensorNoise) -> BTreeMap<String, String> {
    let is_stated = is_stated(campaign, noise);
    let runs = run_states(campaign, noise, Method::Map);
    let fit = |run: super::RunStates| {
        let found = answer(Method::Map, &evidence(Method::Map, campaign, noise, &run.states)).ok()?;
        Some((run.run, in_words(&found.fit?, is_stated)?))
    };
    runs.into_par_iter().filter_map(fit).collect()
}

/// The same of fits that are there already.
pub fn misfits_of(
    campaign: &Campaign,
    noise: &SensorNoise,
    fits: impl Iterator<Item = (String, Fit)>,
) -> BTreeMap<String, String> {
    let is_stated = is_stated(campaign, noise);
    fits.filter_map(|(run, fit)| Some((run, in_words(&fit, is_stated)?))).collect()
}

/// Whether the noise of all that is weighed is stated.
fn is_stated(campaign: &Campaign, noise: &SensorNoise) -> bool {
    let sinkage = campaign.column(Channel::Sinkage.name()).is_some().then_some(noise.sinkage);
    let always = [noise.drawbar_pull, noise.load, noise.torque, noise.slip];
    always.into_iter().chain(sinkage).all(|channel| channel.source == NoiseSource::Campaign)
}

fn in_words(fit: &Fit, is_stated: bool) -> Option<String> {
    let &Fit { chi_square, degrees_of_freedom, p_value } = fit;
    if is_stated {
        return (p_value < SIGNIFICANT).then(|| {
            format!(
                "no soil explains the run: χ² is {chi_square:.0} where {degrees_of_freedom:.0} is expected (p = {p_value:.0e}); what the model \
                 lacks stands in c, φ and K"
            )
        });
    }
    (chi_square > BEYOND_GUESSES * degrees_of_freedom.max(1.0)).then(|| {
        format!(
            "no soil explains the run: χ² is {chi_square:.0} where {degrees_of_freedom:.0} is expected, and noise that is not stated would have \
             to be {:.0} times what it is taken for; units, or what the model lacks, stand in c, φ and K",
            (chi_square / degrees_of_freedom.max(1.0)).sqrt()
        )
    })
}
