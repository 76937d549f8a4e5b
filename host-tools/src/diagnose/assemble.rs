//! The document of a diagnosis, from what the selection found.

use std::collections::BTreeMap;

use crate::data::campaign::{Campaign, Channel};

use super::beyond_noise::beyond_noise;
use super::caveats::{caveats, error_of_load};
use super::document::{
    Candidate, ChannelErrors, Diagnosis, EndsApart, ErrorPair, Estimate, FoundEffect, LevelsLeftOut, RunnerUp,
    Unexplained, Verdict,
};
use super::error_caveats::of_errors;
use super::fit::Reading;
use super::force_channels::ForceChannels;
use super::forward::{FoundStep, Selected};
use super::held_out_errors::HeldOutErrors;
use super::left_over::{LeftOver, left_over};
use super::measurements::{Measurements, column_name};
use super::nearest::nearest;
use super::noise::Noise;
use super::selection::Judged;
use super::sentence::Open;
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
    let channels = channels(measurements, selected, errors);
    let beyond_noise = beyond_noise(campaign, &channels, errors);
    let left_over = left_over(measurements, selected.model());
    let unexplained = unexplained(selected, &left_over, beyond_noise.is_some());
    let mut document = Diagnosis {
        campaign: campaign.name.clone(),
        data: None,
        declared: campaign.declared.ids(),
        declared_effects: Vec::new(),
        verdict: verdict(selected, &unexplained),
        sentence: String::new(),
        effects: selected.found.iter().map(|found| found_effect(measurements, selected.model(), found)).collect(),
        runner_up: runner_up(selected),
        ambiguous_with: selected.found.first().map_or_else(Vec::new, |found| owned(&found.ambiguous_with)),
        deciding_measurement: None,
        force_channels: by_themselves.effects().cloned().collect(),
        unexplained,
        found_law: None,
        channels,
        leave_level_out: levels,
        ends_apart: ends_apart(measurements, selected, errors),
        soil_before: soil(&selected.base),
        soil_after: soil(selected.model()),
        candidates: listed(measurements, selected),
        held_out_runs: held_out_runs(measurements, errors),
        left_out: measurements.left_out.clone(),
        caveats: caveats(campaign, measurements, selected),
    };
    document.caveats.extend(by_themselves.caveats().cloned());
    document.caveats.extend(error_of_load(selected, by_themselves));
    document.caveats.extend(of_errors(measurements, &document));
    let off_by_run = measurements.off_by_run(&selected.model().fit.offset_std);
    let open = Open {
        beyond_noise,
        off_by_run: off_by_run.map(|(reading, _)| column_name(reading)).collect(),
        nearest: nearest(selected),
    };
    super::sentence::tell(&mut document, campaign, &open);
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

/// An effect with what it gained when it was found, and its form and parameters as the final `model` has them.
fn found_effect(measurements: &Measurements, model: &Trial<'_>, found: &FoundStep<'_>) -> FoundEffect {
    let winner = &found.winner;
    FoundEffect {
        id: winner.id().to_owned(),
        form: model.specification.effect(winner.id()).map_or("", |effect| effect.form.name).to_owned(),
        parameters: parameters(measurements, model, winner.id()),
        gain_per_row: winner.held_out.per_row,
        p_value: winner.p_value,
        ambiguous_with: owned(&found.not_told_from()),
    }
}

/// The parameters of one of a trial's effects, as fitted; those at which its form holds it have no spread.
pub fn parameters(measurements: &Measurements, trial: &Trial<'_>, id: &str) -> BTreeMap<String, Estimate> {
    let fitted = trial.places_of(id).map(|(place, name)| (name.to_owned(), estimate(trial, place)));
    let held = trial.specification.effect(id).map_or_else(Vec::new, |effect| effect.held(measurements)).into_iter();
    fitted.chain(held.map(|(name, value)| (name.to_owned(), Estimate { value, std: 0.0 }))).collect()
}

fn estimate(trial: &Trial<'_>, place: usize) -> Estimate {
    Estimate { value: trial.fit.parameters[place], std: trial.std(place) }
}

fn runner_up(selected: &Selected<'_>) -> Option<RunnerUp> {
    let first = selected.found.first();
    let step = first.map(|found| &found.step).or(selected.last.as_ref())?;
    let is_adopted = |judged: &Judged<'_>| selected.found.iter().any(|found| found.winner.id() == judged.id());
    let next = step.ranking.iter().find(|judged| !is_adopted(judged) && judged.held_out.has_answer())?;
    let form = next.effect().map_or("", |effect| effect.form.name).to_owned();
    Some(RunnerUp { id: next.id().to_owned(), form, gain_per_row: next.held_out.per_row })
}

/// Dependences on columns, and of the channels that show none, what is left of them. Where that is nothing, no effect was found, and errors
/// are beyond noise, so that something is missing in any case, the column that comes nearest, if chance does not do that easily.
fn unexplained(selected: &Selected<'_>, left_over: &[LeftOver], is_beyond_noise: bool) -> Vec<Unexplained> {
    let entry = |structure: &super::residual_search::Structure| Unexplained {
        channel: name(structure.channel),
        regressor: structure.regressor(),
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
    let of_sensor = selected.rival.iter().filter_map(|rival| rival.unexplained(selected.model()));
    let of_columns = selected.left.iter().map(entry);
    let mut found: Vec<_> = of_sensor.chain(of_columns).chain(others).take(MOST_UNEXPLAINED).collect();
    if found.is_empty() && selected.found.is_empty() && is_beyond_noise {
        found.extend(selected.guilty.iter().filter(|guilty| guilty.explains_a_misfit()).map(entry));
    }
    found
}

/// The measured channels of which a model may have errors. Those of a load say in newtons what those of the sinkage say in metres; a sinkage
/// that lags behind tells of no load.
pub fn told(measurements: &Measurements, selected: &Selected<'_>) -> Vec<Reading> {
    let lags = selected.model().specification.effect("sinkage-lag").is_some();
    let load = (!lags).then_some(Reading::Load);
    Reading::JUDGED.into_iter().chain(load).filter(|reading| measurements.has(*reading)).collect()
}

/// Every measured channel, with the errors of those that a model predicts.
fn channels(
    measurements: &Measurements,
    selected: &Selected<'_>,
    errors: &HeldOutErrors,
) -> BTreeMap<String, ChannelErrors> {
    let noise_of = |reading: Reading| {
        let Noise { std, stated, of_repeats } = measurements.noise[reading.index()];
        if stated {
            return std;
        }
        // A model that lacks something takes that for noise: what repeats scatter by tells better.
        let by_fit = std * selected.model().fit.noise_scale[reading.index()];
        of_repeats.map_or(by_fit, |of_repeats| of_repeats.min(by_fit))
    };
    let predicted = told(measurements, selected);
    let pair =
        |reading: Reading| predicted.contains(&reading).then(|| errors.pair(reading.index(), |_| true)).flatten();
    // As many newtons as a metre of sinkage is worth.
    let with_sinkage = || {
        let (load, sinkage) = (pair(Reading::Load)?, pair(Reading::Sinkage)?);
        let of_sinkage = noise_of(Reading::Sinkage) * load.rmse_after / sinkage.rmse_after;
        Some(noise_of(Reading::Load).hypot(of_sinkage))
    };
    let of = |reading: Reading| {
        let channel = reading.index();
        let pair = pair(reading);
        let has_any = |rows: &&Vec<usize>| pair.is_some() && rows.iter().any(|row| errors.has(*row, channel));
        ChannelErrors {
            rmse_before: pair.map(|pair| pair.rmse_before),
            rmse_after: pair.map(|pair| pair.rmse_after),
            noise: noise_of(reading),
            noise_with_sinkage: (reading == Reading::Load).then(with_sinkage).flatten(),
            noise_stated: measurements.noise[channel].stated,
            runs: measurements.rows_of_run.iter().filter(has_any).count(),
        }
    };
    let measured = Reading::JUDGED.into_iter().chain([Reading::Load]).filter(|reading| measurements.has(*reading));
    measured.map(|reading| (name(reading), of(reading))).collect()
}

fn name(reading: Reading) -> String {
    column_name(reading).to_owned()
}

/// The runs of which both models predicted anything.
fn held_out_runs(measurements: &Measurements, errors: &HeldOutErrors) -> Vec<String> {
    let has_any = |rows: &[usize]| rows.iter().any(|row| Reading::JUDGED.iter().any(|r| errors.has(*row, r.index())));
    let runs = measurements.runs.iter().zip(&measurements.rows_of_run);
    runs.filter(|(_, rows)| has_any(rows)).map(|(run, _)| run.clone()).collect()
}

/// Root mean square errors before and after on some rows, by channel.
pub fn error_pairs(
    errors: &HeldOutErrors,
    channels: &[Reading],
    rows: impl Fn(usize) -> bool + Copy,
) -> BTreeMap<String, ErrorPair> {
    let pair = |reading: &Reading| Some((name(*reading), errors.pair(reading.index(), rows)?));
    channels.iter().filter_map(pair).collect()
}

/// Of few runs, those at the lowest and the highest slip by themselves.
fn ends_apart(measurements: &Measurements, selected: &Selected<'_>, errors: &HeldOutErrors) -> Option<EndsApart> {
    let channels = told(measurements, selected);
    let count = measurements.runs.len();
    if !(4..=FEW_RUNS).contains(&count) {
        return None;
    }
    let by_slip = |a: &usize, b: &usize| measurements.mean_slip(*a).total_cmp(&measurements.mean_slip(*b));
    let ends = [(0..count).min_by(by_slip)?, (0..count).max_by(by_slip)?];
    let at_end = |row: usize| ends.contains(&measurements.rows[row].run);
    Some(EndsApart {
        runs: ends.iter().map(|run| measurements.runs[*run].clone()).collect(),
        ends: error_pairs(errors, &channels, at_end),
        between: error_pairs(errors, &channels, |row| !at_end(row)),
    })
}

/// The soil as fitted, in the units of `[soil]`, without what the campaign holds fixed.
fn soil(trial: &Trial<'_>) -> BTreeMap<String, Estimate> {
    let free = trial.model.soil_parameters().iter().enumerate().map(|(place, parameter)| {
        let found = estimate(trial, place);
        let value = parameter.value(found.value);
        let std = if parameter.is_logarithmic() { value * found.std } else { found.std };
        (parameter.key().to_owned(), Estimate { value, std })
    });
    free.collect()
}

/// The candidates of each step that had an answer for all runs that the model before had one for.
fn listed(measurements: &Measurements, selected: &Selected<'_>) -> Vec<Candidate> {
    let steps = selected.found.iter().map(|found| &found.step).chain(selected.last.as_ref());
    let entries = |(number, step): (usize, &super::selection::Step<'_>)| {
        let entry = |judged: &Judged<'_>| Candidate {
            step: number + 1,
            id: judged.id().to_owned(),
            form: judged.effect().map_or("", |effect| effect.form.name).to_owned(),
            gain_per_row: judged.held_out.per_row,
            gain_std: judged.held_out.std,
            p_value: Some(judged.p_value),
            parameters: parameters(measurements, &judged.trial, judged.id()),
        };
        step.ranking.iter().filter(|judged| judged.held_out.has_answer()).take(LISTED).map(entry).collect::<Vec<_>>()
    };
    steps.enumerate().flat_map(entries).collect()
}
