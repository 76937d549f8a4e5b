//! The verdict in words, and what measurement would decide between candidates.

use kapvik_firmware::terramechanics::effects::effect_info;

use crate::data::campaign::Campaign;

use super::document::{Diagnosis, FoundEffect, Verdict};
use super::effect_in_words::effect_in_words;
use super::nearest::{Nearest, in_words, no_explanation};

/// What a diagnosis leaves open beside its verdict.
#[derive(Debug, Clone, Default)]
pub struct Open {
    /// The channel that is missed by more than noise allows, and by how many times as much.
    pub beyond_noise: Option<(&'static str, f64)>,
    /// The channels that are off by another amount in each run.
    pub off_by_run: Vec<&'static str>,
    /// The candidate and the column that come nearest to explaining something.
    pub nearest: Vec<Nearest>,
}

/// Puts the sentence, and for an ambiguous verdict the deciding measurement, into a document.
pub fn tell(document: &mut Diagnosis, campaign: &Campaign, open: &Open) {
    document.sentence = sentence(document, campaign, open);
    if document.verdict == Verdict::Ambiguous {
        let ids = document.effects.iter().take(1).map(|effect| &effect.id).chain(&document.ambiguous_with);
        let tests: Vec<_> = ids.filter_map(|id| effect_info(id).map(|info| format!("{id}: {}", info.test))).collect();
        document.deciding_measurement = Some(format!("To tell them apart, measure: {}.", tests.join("; ")));
    }
}

fn sentence(document: &Diagnosis, campaign: &Campaign, open: &Open) -> String {
    let model = if document.declared.is_empty() {
        "the seed's equations".to_owned()
    } else {
        format!("the seed's equations with {} declared", document.declared.join(", "))
    };
    let of = &campaign.name;
    let left = document.unexplained.first().map(|left| match left.regressor.as_str() {
        _ if left.is_along_runs() => format!("{} along runs (t_s)", left.channel),
        column if column == left.channel => format!("{} against its own reading", left.channel),
        column => format!("{} against {column}", left.channel),
    });
    match document.verdict {
        Verdict::None if document.channels.values().all(|errors| errors.pair().is_none()) => {
            format!("{of}: these data cannot judge {model}: nothing could be predicted that no fit knew.")
        }
        Verdict::None if let Some((channel, times)) = open.beyond_noise => format!(
            "{of}: {model} miss {channel} by {times:.1} times its stated noise and that of slip and load, and {}: the noise is larger, or a \
             law is missing.{}",
            no_explanation(&open.nearest),
            in_words(&open.nearest)
        ),
        Verdict::None if let Some(differs) = from_run_to_run(&open.off_by_run) => format!(
            "{of}: within each run {model} explain the data as well as their noise allows, and no candidate earns a place; but {differs}.{}",
            in_words(&open.nearest)
        ),
        Verdict::None => {
            format!("{of}: {model} explain the data as well as their noise allows; no candidate earns a place.")
        }
        Verdict::Unexplained => {
            format!("{of}: {model} leave structure in {} that no known effect explains.", left.unwrap_or_default())
        }
        Verdict::Effect | Verdict::Ambiguous => {
            let left = left.map(|left| format!("structure is left in {left}"));
            let besides =
                left.into_iter().chain(from_run_to_run(&open.off_by_run).map(|differs| format!("and {differs}")));
            let besides: String = besides.map(|besides| format!("; {besides}")).collect();
            format!("{of}: {model} lack {}{besides}.", found(document))
        }
    }
}

/// The effects that were found, and what each is not told from: of the first the likeliest.
fn found(document: &Diagnosis) -> String {
    let one = |(place, effect): (usize, &FoundEffect)| {
        let others = if place == 0 { &document.ambiguous_with } else { &effect.ambiguous_with };
        match others.as_slice() {
            [] => what(effect),
            others => format!("{} (these data do not tell it from {})", what(effect), others.join(" or ")),
        }
    };
    document.effects.iter().enumerate().map(one).collect::<Vec<_>>().join("; then ")
}

/// What is said of channels that are off by another amount in each run; none where none is.
fn from_run_to_run(off_by_run: &[&str]) -> Option<String> {
    (!off_by_run.is_empty()).then(|| {
        format!(
            "from run to run {} {} noise, which nothing measured explains beyond chance",
            off_by_run.join(" and "),
            if off_by_run.len() == 1 { "differs by more than its" } else { "differ by more than their" }
        )
    })
}

fn what(effect: &FoundEffect) -> String {
    let id = &effect.id;
    effect_info(id).map_or_else(|| id.clone(), |info| format!("{id} ({})", effect_in_words(info, &effect.parameters)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::campaign::Carried;

    fn told(verdict: &str, effects: &[&str], off_by_run: &[&'static str]) -> String {
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
        let open = Open { off_by_run: off_by_run.to_vec(), ..Open::default() };
        sentence(&document, &campaign, &open).split_off(campaign.name.len())
    }

    #[test]
    fn what_differs_from_run_to_run_is_said_beside_an_effect_and_without_one() {
        let differs =
            "from run to run sinkage_m differs by more than its noise, which nothing measured explains beyond chance.";
        let [alone, beside] = [("none", &[][..]), ("effect", &["rate", "multi-pass"][..])]
            .map(|(verdict, effects)| told(verdict, effects, &["sinkage_m"]));
        assert!(alone.ends_with(&format!("no candidate earns a place; but {differs}")), "{alone}");
        assert!(beside.contains(" lack rate (") && beside.contains("; then multi-pass ("), "{beside}");
        assert!(beside.ends_with(&format!("; and {differs}")), "{beside}");
        assert!(told("effect", &["rate"], &[]).ends_with(")."), "nothing differs");
    }
}
