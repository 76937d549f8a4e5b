//! The document of a diagnosis, from what the selection found.

use std::collections::BTreeMap;

use crate::data::campaign::{Campaign, Channel};

use super::document::{
    Candidate, ChannelErrors, Diagnosis, EndsApart, ErrorPair, Estimate, FoundEffect, LevelsLeftOut, RunnerUp,
    Unexplained, Verdict,
};
use super::fit::Reading;
use super::force_channels::ForceChannels;
use super::forward::Selected;
use super::held_out_errors::{HeldOutErrors, rmse};
use super::left_over::{LeftOver, left_over};
use super::measurements::{COLUMNS, Measurements};
use super::selection::Judged;
use super::trial::Trial;

/// Entries of `unexplained`.
const MOST_UNEXPLAINED: usize = 5;
/// Candidates of a step that the document lists.
const LISTED: usize = 12;
/// Runs up to which the ends are told apart.
const FEW_RUNS: usize = 10;

/// The document.
pub fn assemble(
    campaign: &Campaign,
    measurements: &Measurements,
    selected: &Selected<'_>,
    errors: &HeldOutErrors,
    levels: Option<LevelsLeftOut>,
    by_themselves: &ForceChannels,
) -> Diagnosis {
    let unexplained = unexplained(selected, &left_over(measurements, selected.model()));
    let mut document = Diagnosis {
        campaign: campaign.name.clone(),
        data: None,
        declared: campaign.declared.ids(),
        verdict: verdict(selected, &unexplained),
        sentence: String::new(),
        effects: selected.found.iter().map(|found| found_effect(&found.winner)).collect(),
        runner_up: runner_up(selected),
        ambiguous_with: selected.found.first().map_or_else(Vec::new, |found| owned(&found.ambiguous_with)),
        deciding_measurement: None,
        force_channels: by_themselves.effects.clone(),
        unexplained,
        found_law: None,
        channels: channels(measurements, selected, errors),
        leave_level_out: levels,
        ends_apart: ends_apart(measurements, errors),
        soil_before: soil(&selected.base),
        soil_after: soil(selected.model()),
        candidates: listed(selected),
        held_out_runs: measurements.runs.clone(),
        left_out: measurements.left_out.clone(),
        caveats: super::caveats::caveats(campaign, measurements, selected),
    };
    document.caveats.extend(by_themselves.caveats.iter().cloned());
    super::sentence::tell(&mut document, campaign);
    document
}

fn verdict(selected: &Selected<'_>, unexplained: &[Unexplained]) -> Verdict {
    match selected.found.first() {
        Some(found) if !found.ambiguous_with.is_empty() => Verdict::Ambiguous,
        Some(_) => Verdict::Effect,
        None if !unexplained.is_empty() => Verdict::Unexplained,
        None => Verdict::None,
    }
}

fn owned(ids: &[&str]) -> Vec<String> {
    ids.iter().map(|id| (*id).to_owned()).collect()
}

fn found_effect(winner: &Judged<'_>) -> FoundEffect {
    FoundEffect {
        id: winner.id().to_owned(),
        form: winner.effect().map_or("", |effect| effect.form.name).to_owned(),
        parameters: parameters(&winner.trial),
        gain_per_row: winner.held_out.per_row,
        p_value: winner.p_value,
    }
}

/// The parameters of a trial's last effect, as fitted.
fn parameters(trial: &Trial<'_>) -> BTreeMap<String, Estimate> {
    let id = trial.specification.effects.last().map_or("", |effect| effect.info.id);
    let soil = trial.model.soil_count();
    let own = trial.model.effect_parameters().iter().enumerate().filter(|(_, (effect, _))| *effect == id);
    own.map(|(offset, (_, name))| ((*name).to_owned(), estimate(trial, soil + offset))).collect()
}

fn estimate(trial: &Trial<'_>, place: usize) -> Estimate {
    let variance = trial.fit.covariance[(place, place)].max(0.0) * trial.fit.dispersion.max(1.0);
    Estimate { value: trial.fit.parameters[place], std: variance.sqrt() }
}

fn runner_up(selected: &Selected<'_>) -> Option<RunnerUp> {
    let first = selected.found.first();
    let step = first.map(|found| &found.step).or(selected.last.as_ref())?;
    let winner = first.map_or("", |found| found.winner.id());
    let next = step.ranking.iter().find(|judged| judged.id() != winner)?;
    let form = next.effect().map_or("", |effect| effect.form.name).to_owned();
    Some(RunnerUp { id: next.id().to_owned(), form, gain_per_row: next.held_out.per_row })
}

/// Dependences on columns, and of the channels that show none, what is left of them.
fn unexplained(selected: &Selected<'_>, left_over: &[LeftOver]) -> Vec<Unexplained> {
    let entry = |structure: &super::residual_search::Structure| Unexplained {
        channel: name(structure.channel),
        regressor: structure.regressor.clone(),
        share_of_variance: structure.share_of_variance,
        p_value: structure.p_value,
    };
    let of_no_column = |left: &LeftOver| Unexplained {
        channel: name(left.channel),
        regressor: Channel::Time.name().to_owned(),
        share_of_variance: left.share_of_variance,
        p_value: left.p_value,
    };
    let is_told = |left: &&LeftOver| selected.left.iter().any(|structure| structure.channel == left.channel);
    let others = left_over.iter().filter(|left| !is_told(left)).map(of_no_column);
    selected.left.iter().map(entry).chain(others).take(MOST_UNEXPLAINED).collect()
}

/// Every measured channel that a model predicts.
fn channels(
    measurements: &Measurements,
    selected: &Selected<'_>,
    errors: &HeldOutErrors,
) -> BTreeMap<String, ChannelErrors> {
    let judged = Reading::JUDGED.into_iter().filter(|reading| measurements.has(*reading));
    let of = |reading: Reading| {
        let channel = reading.index();
        let everywhere = |_| true;
        let runs = measurements
            .rows_of_run
            .iter()
            .filter(|rows| rows.iter().any(|row| errors.before[*row][channel].is_some()));
        let noise = measurements.noise[channel];
        Some(ChannelErrors {
            rmse_before: rmse(&errors.before, channel, everywhere)?,
            rmse_after: rmse(&errors.after, channel, everywhere)?,
            noise: noise.std * if noise.stated { 1.0 } else { selected.model().fit.noise_scale[channel] },
            noise_stated: noise.stated,
            runs: runs.count(),
        })
    };
    judged.filter_map(|reading| Some((name(reading), of(reading)?))).collect()
}

fn name(reading: Reading) -> String {
    COLUMNS[reading.index()].name().to_owned()
}

/// Root mean square errors before and after on some rows, by channel.
pub fn error_pairs(errors: &HeldOutErrors, rows: impl Fn(usize) -> bool + Copy) -> BTreeMap<String, ErrorPair> {
    let pair = |reading: Reading| {
        let rmse_before = rmse(&errors.before, reading.index(), rows)?;
        Some((name(reading), ErrorPair { rmse_before, rmse_after: rmse(&errors.after, reading.index(), rows)? }))
    };
    Reading::JUDGED.into_iter().filter_map(pair).collect()
}

/// Of few runs, those at the lowest and the highest slip by themselves.
fn ends_apart(measurements: &Measurements, errors: &HeldOutErrors) -> Option<EndsApart> {
    let count = measurements.runs.len();
    if !(4..=FEW_RUNS).contains(&count) {
        return None;
    }
    let by_slip = |a: &usize, b: &usize| measurements.mean_slip(*a).total_cmp(&measurements.mean_slip(*b));
    let ends = [(0..count).min_by(by_slip)?, (0..count).max_by(by_slip)?];
    let at_end = |row: usize| ends.contains(&measurements.rows[row].run);
    Some(EndsApart {
        runs: ends.iter().map(|run| measurements.runs[*run].clone()).collect(),
        ends: error_pairs(errors, at_end),
        between: error_pairs(errors, |row| !at_end(row)),
    })
}

/// The soil as fitted, in the units of `[soil]`; what is held fixed by the campaign has no spread.
fn soil(trial: &Trial<'_>) -> BTreeMap<String, Estimate> {
    let free = trial.model.soil_parameters().iter().enumerate().map(|(place, parameter)| {
        let found = estimate(trial, place);
        let value = parameter.value(found.value);
        let std = if parameter.is_logarithmic() { value * found.std } else { found.std };
        (parameter.key().to_owned(), Estimate { value, std })
    });
    free.collect()
}

fn listed(selected: &Selected<'_>) -> Vec<Candidate> {
    let steps = selected.found.iter().map(|found| &found.step).chain(selected.last.as_ref());
    let entries = |(number, step): (usize, &super::selection::Step<'_>)| {
        let entry = |judged: &Judged<'_>| Candidate {
            step: number + 1,
            id: judged.id().to_owned(),
            form: judged.effect().map_or("", |effect| effect.form.name).to_owned(),
            gain_per_row: judged.held_out.per_row,
            gain_std: judged.held_out.std,
            p_value: Some(judged.p_value),
            parameters: parameters(&judged.trial),
        };
        step.ranking.iter().take(LISTED).map(entry).collect::<Vec<_>>()
    };
    steps.enumerate().flat_map(entries).collect()
}
