//! What a reader of errors on held-out runs should know about them.

use super::document::{ChannelErrors, Diagnosis, ErrorPair};
use super::measurements::Measurements;

/// Times the error of the declared model from which one has grown by more than what changes with the runs that are left out.
const GROWS: f64 = 1.05;

/// Sentence by sentence.
pub fn of_errors(measurements: &Measurements, document: &Diagnosis) -> Vec<String> {
    let said =
        [without_answer(measurements, &document.held_out_runs), no_error_falls(document), errors_that_grow(document)];
    said.into_iter().flatten().collect()
}

/// What is said where a run that was held out is predicted by one of the models or by none.
fn without_answer(measurements: &Measurements, predicted: &[String]) -> Option<String> {
    let runs: Vec<&str> = measurements.runs.iter().filter(|run| !predicted.contains(run)).map(String::as_str).collect();
    let why = match measurements.runs.len() {
        1 => "there is nothing else to fit",
        _ => "on the soil that these came to the wheel finds no hold",
    };
    (!runs.is_empty()).then(|| {
        format!(
            "Not predicted by fits that did not know them, since {why}: {}. Errors before and after are without them.",
            runs.join(", ")
        )
    })
}

/// What is said where something was found and no channel is predicted the better for it.
fn no_error_falls(document: &Diagnosis) -> Option<String> {
    let mut pairs = document.channels.values().filter_map(ChannelErrors::pair).peekable();
    let is_any = pairs.peek().is_some();
    let falls = pairs.any(|pair| pair.rmse_after < pair.rmse_before);
    (!document.effects.is_empty() && is_any && !falls).then(|| {
        "No root mean square error falls on runs that no fit knew: what was found makes them more probable, as by saying better what is \
         uncertain, but predicts none of them better."
            .to_owned()
    })
}

/// What is said of channels that something found predicts worse.
fn errors_that_grow(document: &Diagnosis) -> Option<String> {
    let grows = |pair: &ErrorPair| pair.rmse_after > GROWS * pair.rmse_before && pair.rmse_before > 0.0;
    let percent = |pair: ErrorPair| 100.0 * (pair.rmse_after / pair.rmse_before - 1.0);
    let pairs = document.channels.iter().filter_map(|(channel, errors)| Some((channel, errors.pair()?)));
    let worse = pairs.filter(|(_, pair)| grows(pair));
    let worse: Vec<_> = worse.map(|(channel, pair)| format!("{channel} (by {:.0} %)", percent(pair))).collect();
    (!document.effects.is_empty() && !worse.is_empty()).then(|| {
        format!(
            "With what was found, root mean square errors grow on runs that no fit knew, of {}: there the declared model predicts better.",
            worse.join(", ")
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn document(effects: serde_json::Value) -> Diagnosis {
        let errors = |rmse_before, rmse_after| ChannelErrors {
            rmse_before: Some(rmse_before),
            rmse_after: Some(rmse_after),
            noise: 1.0,
            noise_with_sinkage: None,
            noise_stated: true,
            runs: 9,
        };
        let document = serde_json::json!({
            "campaign": "sand", "declared": [], "verdict": "effect", "effects": effects, "runner_up": null,
            "ambiguous_with": [], "unexplained": [],
            "channels": {
                "drawbar_pull_n": errors(1.0, 1.04), "load_n": errors(10.0, 12.0), "sinkage_m": errors(0.004, 0.001),
                "torque_nm": errors(0.1, 0.107),
            },
            "soil_before": {}, "soil_after": {}, "held_out_runs": [],
        });
        serde_json::from_value(document).expect("a diagnosis")
    }

    #[test]
    fn channels_that_an_effect_predicts_worse_are_named() {
        let found =
            document(serde_json::json!([{ "id": "rate", "parameters": {}, "gain_per_row": 1.0, "p_value": 0.0 }]));
        let said = errors_that_grow(&found).expect("two grow");
        assert!(said.contains(" of load_n (by 20 %), torque_nm (by 7 %): "), "{said}");
        assert_eq!(no_error_falls(&found), None);
        assert_eq!(errors_that_grow(&document(serde_json::json!([]))), None, "nothing was found");
    }
}
