//! The verdict in words, and what measurement would decide between candidates.

use kapvik_firmware::terramechanics::effects::effect_info;

use crate::data::campaign::{Campaign, Channel};

use super::document::{Diagnosis, Verdict};
use super::fit::Reading;
use super::held_out_errors::HeldOutErrors;
use super::measurements::column_name;

/// Times what the stated noise allows from which errors on held-out runs are not that noise.
const BEYOND_NOISE: f64 = 2.0;

/// Puts the sentence, and for an ambiguous verdict the deciding measurement, into a document; `off_by_run` are the channels that are off by
/// another amount in each run.
pub fn tell(document: &mut Diagnosis, campaign: &Campaign, errors: &HeldOutErrors, off_by_run: &[&str]) {
    document.sentence = sentence(document, campaign, errors, off_by_run);
    if document.verdict == Verdict::Ambiguous {
        let ids = document.effects.iter().take(1).map(|effect| &effect.id).chain(&document.ambiguous_with);
        let tests: Vec<_> = ids.filter_map(|id| effect_info(id).map(|info| format!("{id}: {}", info.test))).collect();
        document.deciding_measurement = Some(format!("To tell them apart, measure: {}.", tests.join("; ")));
    }
}

fn sentence(document: &Diagnosis, campaign: &Campaign, errors: &HeldOutErrors, off_by_run: &[&str]) -> String {
    let model = if document.declared.is_empty() {
        "the seed's equations".to_owned()
    } else {
        format!("the seed's equations with {} declared", document.declared.join(", "))
    };
    let of = &campaign.name;
    let left = document.unexplained.first().map(|left| match left.regressor.as_str() {
        "t_s" => format!("{} along runs (t_s)", left.channel),
        column => format!("{} against {column}", left.channel),
    });
    match document.verdict {
        Verdict::None if document.channels.is_empty() => {
            format!("{of}: these data cannot judge {model}: nothing could be predicted that no fit knew.")
        }
        Verdict::None if let Some((channel, times)) = beyond_noise(document, campaign, errors) => format!(
            "{of}: {model} miss {channel} by {times:.1} times its stated noise and that of slip and load, and no candidate and no column \
             explains that: the noise is larger, or a law is missing that follows nothing measured."
        ),
        Verdict::None if !off_by_run.is_empty() => format!(
            "{of}: within each run {model} explain the data as well as their noise allows, and no candidate earns a place; but from run to run \
             {} differs by more than its noise, which nothing measured explains.",
            off_by_run.join(" and ")
        ),
        Verdict::None => {
            format!("{of}: {model} explain the data as well as their noise allows; no candidate earns a place.")
        }
        Verdict::Unexplained => {
            format!("{of}: {model} leave structure in {} that no known effect explains.", left.unwrap_or_default())
        }
        Verdict::Effect | Verdict::Ambiguous => {
            let found: Vec<_> = document.effects.iter().map(|effect| what(&effect.id)).collect();
            let or = match document.ambiguous_with.as_slice() {
                [] => String::new(),
                others => format!(" (these data do not tell it from {})", others.join(" or ")),
            };
            let left = left.map_or_else(String::new, |left| format!("; structure is left in {left}"));
            let first = found.first().cloned().unwrap_or_default();
            let then = if found.len() > 1 { format!("; then {}", found[1..].join("; then ")) } else { String::new() };
            format!("{of}: {model} lack {first}{or}{then}{left}.")
        }
    }
}

/// The channel of stated noise that is missed by most of what noise allows on held-out runs, and by how much, where that is far from one. None
/// where no load is measured: what stands in for it has a noise of its own.
fn beyond_noise(document: &Diagnosis, campaign: &Campaign, errors: &HeldOutErrors) -> Option<(&'static str, f64)> {
    campaign.column(Channel::Load.name())?;
    let is_stated = |channel| document.channels.get(channel).is_some_and(|errors| errors.noise_stated);
    let channels = Reading::JUDGED.into_iter().map(|reading| (reading, column_name(reading)));
    let stated = channels.filter(|(_, channel)| is_stated(*channel));
    let missed = stated.filter_map(|(reading, channel)| Some((channel, errors.times_expected(reading.index())?)));
    missed.filter(|(_, times)| *times > BEYOND_NOISE).max_by(|a, b| a.1.total_cmp(&b.1))
}

fn what(id: &str) -> String {
    effect_info(id).map_or_else(|| id.to_owned(), |info| format!("{id} ({})", info.summary))
}
