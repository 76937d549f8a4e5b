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

/// Why runs are explained by no soil, by their names. Nothing is said where a noise was only guessed, for a misfit then may be the guess's.
pub fn misfits(campaign: &Campaign, noise: &SensorNoise) -> BTreeMap<String, String> {
    if !is_stated(campaign, noise) {
        return BTreeMap::new();
    }
    let runs = run_states(campaign, noise, Method::Map);
    let fit = |run: super::RunStates| {
        let found = answer(Method::Map, &evidence(Method::Map, campaign, noise, &run.states)).ok()?;
        Some((run.run, in_words(&found.fit?)?))
    };
    runs.into_par_iter().filter_map(fit).collect()
}

/// The same of fits that are there already.
pub fn misfits_of(
    campaign: &Campaign,
    noise: &SensorNoise,
    fits: impl Iterator<Item = (String, Fit)>,
) -> BTreeMap<String, String> {
    fits.filter(|_| is_stated(campaign, noise)).filter_map(|(run, fit)| Some((run, in_words(&fit)?))).collect()
}

/// Whether the noise of all that is weighed is stated: each guess may be wrong by so much that no soil fits.
fn is_stated(campaign: &Campaign, noise: &SensorNoise) -> bool {
    let sinkage = campaign.column(Channel::Sinkage.name()).is_some().then_some(noise.sinkage);
    let always = [noise.drawbar_pull, noise.load, noise.torque, noise.slip];
    always.into_iter().chain(sinkage).all(|channel| channel.source == NoiseSource::Campaign)
}

fn in_words(fit: &Fit) -> Option<String> {
    (fit.p_value < SIGNIFICANT).then(|| {
        format!(
            "no soil explains the run: χ² is {:.0} where {:.0} is expected (p = {:.0e}); what the model lacks stands in c, φ and K",
            fit.chi_square, fit.degrees_of_freedom, fit.p_value
        )
    })
}
