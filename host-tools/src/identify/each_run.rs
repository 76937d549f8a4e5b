//! Each run of a campaign by one of the methods.

use rayon::prelude::*;

use crate::data::campaign::Campaign;
use crate::error::HostError;

use super::method::{Finding, Method, answer, rehearse};
use super::on_curve::evidence;
use super::run_states::{RunStates, check_columns, run_states};
use super::{Document, SensorNoise};

/// Identifies every run by a method other than the flight computer's own networks.
///
/// # Errors
/// Where the campaign lacks a column that the method needs.
pub fn identify_by(method: Method, campaign: &Campaign) -> Result<Document, HostError> {
    check_columns(campaign, method.name(), method.needs())?;
    let noise = SensorNoise::of(campaign);
    let runs = run_states(campaign, &noise, method);
    let seen = method.sees(campaign);
    let found: Vec<_> = runs.into_par_iter().map(|states| of_run(method, &seen, &noise, states)).collect();
    Ok(Document::by(method, campaign, &noise, &found))
}

fn of_run(
    method: Method,
    campaign: &Campaign,
    noise: &SensorNoise,
    states: RunStates,
) -> (RunStates, Result<Finding, String>) {
    let found = if states.states.is_empty() {
        Err(format!("no row can be used: {}", states.reasons_in_words()))
    } else {
        let evidence = evidence(method, campaign, noise, &states.states);
        answer(method, &evidence).map(|mut finding| {
            // The soils that are drawn know no effects.
            if campaign.declared.ids().is_empty() {
                rehearse(method, &evidence, &states.states, noise, &mut finding);
            }
            finding
        })
    };
    (states, found)
}
