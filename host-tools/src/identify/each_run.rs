//! Each run of a campaign by one of the methods.

use indicatif::ProgressBar;
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
    identify_beside(method, campaign, &ProgressBar::hidden())
}

/// The same beside a bar over the runs.
///
/// # Errors
/// As [`identify_by`].
pub fn identify_beside(method: Method, campaign: &Campaign, bar: &ProgressBar) -> Result<Document, HostError> {
    check_columns(campaign, method)?;
    let noise = SensorNoise::of(campaign);
    let runs = run_states(campaign, &noise, method);
    let seen = method.sees(campaign);
    bar.set_length(runs.len() as u64);
    let of_run = |states| {
        let found = of_run(method, &seen, &noise, states);
        bar.inc(1);
        found
    };
    let found: Vec<_> = runs.into_par_iter().map(of_run).collect();
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
            rehearse(method, &evidence, &states.states, noise, &mut finding);
            finding
        })
    };
    (states, found)
}
