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
        _ if left.is_along_runs() => format!("{} along runs (t_s)", left.channel),
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
        Verdict::None if let Some(differs) = from_run_to_run(off_by_run) => format!(
            "{of}: within each run {model} explain the data as well as their noise allows, and no candidate earns a place; but {differs}."
        ),
        Verdict::None => {
            format!("{of}: {model} explain the data as well as their noise allows; no candidate earns a place.")
        }
        Verdict::Unexplained => {
            format!("{of}: {model} leave structure in {} that no known effect explains.", left.unwrap_or_default())
        }
        Verdict::Effect | Verdict::Ambiguous => {
            let left = left.map(|left| format!("structure is left in {left}"));
            let besides = left.into_iter().chain(from_run_to_run(off_by_run).map(|differs| format!("and {differs}")));
            let besides: String = besides.map(|besides| format!("; {besides}")).collect();
            format!("{of}: {model} lack {}{besides}.", found(document))
        }
    }
}

/// The effects that were found, and what the first is not told from.
fn found(document: &Diagnosis) -> String {
    let found: Vec<_> = document.effects.iter().map(|effect| what(&effect.id)).collect();
    let or = match document.ambiguous_with.as_slice() {
        [] => String::new(),
        others => format!(" (these data do not tell it from {})", others.join(" or ")),
    };
    let first = found.first().cloned().unwrap_or_default();
    let then = if found.len() > 1 { format!("; then {}", found[1..].join("; then ")) } else { String::new() };
    format!("{first}{or}{then}")
}

/// What is said of channels that are off by another amount in each run; none where none is.
fn from_run_to_run(off_by_run: &[&str]) -> Option<String> {
    (!off_by_run.is_empty()).then(|| {
        format!(
            "from run to run {} {} noise, which nothing measured explains",
            off_by_run.join(" and "),
            if off_by_run.len() == 1 { "differs by more than its" } else { "differ by more than their" }
        )
    })
}

/// The channel of stated noise that is missed by most of what noise allows on held-out runs, and by how much, where that is far from one. None
/// where no load is measured: what stands in for it has a noise of its own.
fn beyond_noise(document: &Diagnosis, campaign: &Campaign, errors: &HeldOutErrors) -> Option<(&'static str, f64)> {
    campaign.column(Channel::Load.name())?.iter().flatten().next()?;
    let is_stated = |channel| document.channels.get(channel).is_some_and(|errors| errors.noise_stated);
    let channels = Reading::JUDGED.into_iter().map(|reading| (reading, column_name(reading)));
    let stated = channels.filter(|(_, channel)| is_stated(*channel));
    let missed = stated.filter_map(|(reading, channel)| Some((channel, errors.times_expected(reading.index())?)));
    missed.filter(|(_, times)| *times > BEYOND_NOISE).max_by(|a, b| a.1.total_cmp(&b.1))
}

fn what(id: &str) -> String {
    effect_info(id).map_or_else(|| id.to_owned(), |info| format!("{id} ({})", info.summary))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::campaign::Carried;

    fn told(verdict: &str, effects: &[&str], off_by_run: &[&str]) -> String {
        let effect = |id: &&str| serde_json::json!({ "id": id, "parameters": {}, "gain_per_row": 1.0, "p_value": 0.0 });
        let document = serde_json::json!({
            "campaign": "sand", "declared": [], "verdict": verdict,
            "effects": effects.iter().map(effect).collect::<Vec<_>>(), "runner_up": null, "ambiguous_with": [],
            "unexplained": [],
            "channels": { "sinkage_m": { "rmse_before": 2.0, "rmse_after": 1.0, "noise": 1.0, "runs": 9 } },
            "soil_before": {}, "soil_after": {}, "held_out_runs": [],
        });
        let document: Diagnosis = serde_json::from_value(document).expect("a diagnosis");
        let campaign = Carried::CmuSmoothStraight.campaign().expect("the project's own figures");
        sentence(&document, &campaign, &HeldOutErrors::none_yet(0), off_by_run).split_off(campaign.name.len())
    }

    #[test]
    fn what_differs_from_run_to_run_is_said_beside_an_effect_and_without_one() {
        let differs = "from run to run sinkage_m differs by more than its noise, which nothing measured explains.";
        let [alone, beside] = [("none", &[][..]), ("effect", &["rate", "multi-pass"][..])]
            .map(|(verdict, effects)| told(verdict, effects, &["sinkage_m"]));
        assert!(alone.ends_with(&format!("no candidate earns a place; but {differs}")), "{alone}");
        assert!(beside.contains(" lack rate (") && beside.contains("; then multi-pass ("), "{beside}");
        assert!(beside.ends_with(&format!("; and {differs}")), "{beside}");
        assert!(told("effect", &["rate"], &[]).ends_with(")."), "nothing differs");
    }
}
