//! What `diagnose` prints: JSON.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};

use crate::data::campaign::{Channel, Fingerprint};

/// A campaign, diagnosed. All quantities are in SI units, angles in rad.
///
/// "Before" is the declared model with its soil parameters refitted, "after" the same with the effects that were found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Diagnosis {
    /// The name of the campaign.
    pub campaign: String,
    /// What tells its measurements from others by that name; none in documents from before there was one.
    #[serde(default)]
    pub data: Option<Fingerprint>,
    /// The ids of the effects that the model was told of.
    pub declared: Vec<String>,
    /// The same as fitted, in the model with the effects that were found.
    #[serde(default)]
    pub declared_effects: Vec<DeclaredFit>,
    /// What came of it.
    pub verdict: Verdict,
    /// The verdict in one sentence.
    #[serde(default)]
    pub sentence: String,
    /// The effects that earned their place, in the order in which they were found.
    pub effects: Vec<FoundEffect>,
    /// The best other candidate of the first step.
    pub runner_up: Option<RunnerUp>,
    /// The ids that these data cannot tell from the first effect, the likeliest.
    pub ambiguous_with: Vec<String>,
    /// What measurement would tell them apart.
    #[serde(default)]
    pub deciding_measurement: Option<String>,
    /// Effects that the force channels show by themselves, without a model of wheel and soil: of the load against its set
    /// levels, and of the side force of a wheel that runs straight. Braking rows count as well.
    #[serde(default)]
    pub force_channels: Vec<FoundEffect>,
    /// Structure that no known effect explains, the most important first.
    pub unexplained: Vec<Unexplained>,
    /// A law that a search of formulas found for it: found, not understood.
    #[serde(default)]
    pub found_law: Option<FoundLaw>,
    /// Every measured channel, by the name of its column.
    pub channels: BTreeMap<String, ChannelErrors>,
    /// The same errors where whole slip levels were left out of the fit.
    #[serde(default)]
    pub leave_level_out: Option<LevelsLeftOut>,
    /// The same errors apart for the runs at the two ends of the slips, where a held-out prediction extrapolates.
    #[serde(default)]
    pub ends_apart: Option<EndsApart>,
    /// The soil of the declared model; keys as in `[soil]`.
    pub soil_before: BTreeMap<String, Estimate>,
    /// The soil with the effects found; keys as in `[soil]`.
    pub soil_after: BTreeMap<String, Estimate>,
    /// The best candidates of each step that had an answer, in the order of preference.
    #[serde(default)]
    pub candidates: Vec<Candidate>,
    /// The runs whose errors are in `channels`: each was predicted by fits that did not know it.
    pub held_out_runs: Vec<String>,
    /// Rows that were not used.
    #[serde(default)]
    pub left_out: Vec<LeftOut>,
    /// What a reader of the result should know, sentence by sentence.
    #[serde(default)]
    pub caveats: Vec<String>,
}

/// What came of a diagnosis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// At least one effect earned its place.
    Effect,
    /// No candidate earned its place, and nothing is left that needs one.
    None,
    /// Structure is left that no known effect explains.
    Unexplained,
    /// Candidates explain the data equally well.
    Ambiguous,
}

impl fmt::Display for Verdict {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Effect => "effect",
            Self::None => "none",
            Self::Unexplained => "unexplained",
            Self::Ambiguous => "ambiguous",
        })
    }
}

/// A value with one standard deviation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// One standard deviation, 0 or more.
    pub std: f64,
}

/// An effect that the model was told of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DeclaredFit {
    /// Its id.
    pub id: String,
    /// The form that was stated, or the one that fits best.
    pub form: String,
    /// As in [`FoundEffect`].
    pub parameters: BTreeMap<String, Estimate>,
}

/// An effect that earned its place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FoundEffect {
    /// Its id.
    pub id: String,
    /// The form in which it was found, of those that the effect has.
    #[serde(default)]
    pub form: String,
    /// The parameters that this form frees, as fitted to all runs in the model with all effects found; and those at which it holds the
    /// effect (such as the load at which one that grows with load does nothing), with no spread.
    pub parameters: BTreeMap<String, Estimate>,
    /// Gain in log predictive density of held-out rows over the model before it, nats a row; of the first of two that were found together
    /// over the model with the second alone.
    pub gain_per_row: f64,
    /// How likely chance gives that gain to the best of all candidates, 0 … 1.
    pub p_value: f64,
    /// The ids that these data cannot tell from it, all of them, the likeliest first; [`Diagnosis::ambiguous_with`] names no more than the
    /// likeliest of the first effect.
    #[serde(default)]
    pub ambiguous_with: Vec<String>,
}

/// The best of the candidates that did not win.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunnerUp {
    /// Its id.
    pub id: String,
    /// Its form.
    #[serde(default)]
    pub form: String,
    /// As in [`FoundEffect`].
    pub gain_per_row: f64,
}

/// Structure in a residual.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Unexplained {
    /// The channel that has it.
    pub channel: String,
    /// The column that it follows; a product is written `slip*sinkage_m`. The time of a run, where no column is followed and neighbouring rows
    /// are alike.
    pub regressor: String,
    /// The share of the residual's variance that follows that column, 0 … 1.
    pub share_of_variance: f64,
    /// How likely chance does that, with all columns that were tried, 0 … 1.
    pub p_value: f64,
}

impl Unexplained {
    /// Whether it follows the time of a run, or no column at all but itself along runs.
    pub fn is_along_runs(&self) -> bool {
        self.regressor == Channel::Time.name()
    }
}

/// A formula for structure that no known effect explains.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FoundLaw {
    /// The channel that it corrects.
    pub channel: String,
    /// The correction in terms of columns and dimensionless groups.
    pub formula: String,
    /// Its coefficient, in the unit that the formula states.
    pub coefficient: Estimate,
    /// As in [`FoundEffect`].
    pub gain_per_row: f64,
}

/// How well a channel is predicted on runs that took no part in the fits; in the channel's unit. Effects are chosen without them, too, among
/// the candidates that all runs leave in question; two that show only together, and how many there are, all runs chose.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ChannelErrors {
    /// Root mean square error of the declared model; none of a channel that no model predicts, as a load beside which no sinkage is measured.
    pub rmse_before: Option<f64>,
    /// Root mean square error with the effects found; none of the same.
    pub rmse_after: Option<f64>,
    /// One standard deviation of a reading. Where it is not stated, what the last fit takes it for, or what like rows of two runs scatter by
    /// where that is less.
    pub noise: f64,
    /// Of a load, whose error is against the sinkage: the same with what the sinkage's noise is worth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub noise_with_sinkage: Option<f64>,
    /// Whether that was stated by the campaign, or estimated.
    #[serde(default)]
    pub noise_stated: bool,
    /// Held-out runs that have the channel.
    pub runs: usize,
}

impl ChannelErrors {
    /// Both errors, where there are any.
    pub fn pair(&self) -> Option<ErrorPair> {
        Some(ErrorPair { rmse_before: self.rmse_before?, rmse_after: self.rmse_after? })
    }

    /// What noise alone makes of an error.
    pub fn noise_of_error(&self) -> f64 {
        self.noise_with_sinkage.unwrap_or(self.noise)
    }
}

/// Errors of a channel before and after, in its unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ErrorPair {
    /// Root mean square error of the declared model.
    pub rmse_before: f64,
    /// Root mean square error with the effects found.
    pub rmse_after: f64,
}

/// Errors on slips that no fitted run had.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LevelsLeftOut {
    /// The slips that were left out in turn, each with all its runs.
    pub slips: Vec<f64>,
    /// By the name of the channel's column.
    pub channels: BTreeMap<String, ErrorPair>,
}

/// Held-out errors of the runs at the lowest and highest slip, apart from those between.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EndsApart {
    /// The runs at the ends.
    pub runs: Vec<String>,
    /// Errors of those, by the name of the channel's column.
    pub ends: BTreeMap<String, ErrorPair>,
    /// Errors of all others.
    pub between: BTreeMap<String, ErrorPair>,
}

/// A candidate that was tried.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Candidate {
    /// The step of the forward selection, from 1: how many effects the model had if this one is the last of them.
    pub step: usize,
    /// Its id.
    pub id: String,
    /// Its form.
    pub form: String,
    /// As in [`FoundEffect`].
    pub gain_per_row: f64,
    /// One standard deviation of that, over runs.
    pub gain_std: f64,
    /// As in [`FoundEffect`].
    pub p_value: Option<f64>,
    /// As in [`FoundEffect`], in the model of its step.
    pub parameters: BTreeMap<String, Estimate>,
}

/// Rows that were not used, and why.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct LeftOut {
    /// Why.
    pub reason: String,
    /// How many.
    pub rows: usize,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The example of the interface, with an entry in every list.
    const EXAMPLE: &str = r#"{
        "campaign": "sand", "declared": [],
        "verdict": "ambiguous",
        "effects": [ { "id": "slip-sinkage", "parameters": {"n1": {"value": 0.3, "std": 0.03}}, "gain_per_row": 1.2,
                       "p_value": 1e-9 } ],
        "runner_up": { "id": "load-stiffening", "gain_per_row": 0.4 },
        "ambiguous_with": ["rate"],
        "unexplained": [ { "channel": "torque_nm", "regressor": "temperature_c", "share_of_variance": 0.4,
                           "p_value": 1e-6 } ],
        "channels": { "sinkage_m": { "rmse_before": 0.0041, "rmse_after": 0.0018, "noise": 0.0007, "runs": 15 } },
        "soil_before": {}, "soil_after": {},
        "held_out_runs": ["a"]
    }"#;

    #[test]
    fn the_interface_is_kept() {
        let read: Diagnosis = serde_json::from_str(EXAMPLE).expect("the example");
        assert_eq!(read.verdict, Verdict::Ambiguous);
        let expected: serde_json::Value = serde_json::from_str(EXAMPLE).expect("the example");
        assert_contains(&serde_json::to_value(&read).expect("JSON"), &expected, "");
    }

    #[test]
    fn nothing_found_is_a_null() {
        let mut read: Diagnosis = serde_json::from_str(EXAMPLE).expect("the example");
        read.runner_up = None;
        read.verdict = Verdict::None;
        let written = serde_json::to_value(&read).expect("JSON");
        assert!(written["runner_up"].is_null());
        assert_eq!(written["verdict"], "none");
        assert_eq!(serde_json::from_value::<Diagnosis>(written).expect("what was written"), read);
    }

    /// Each effect has its own; documents from before that have none.
    #[test]
    fn what_each_effect_is_not_told_from_stands_with_it() {
        let mut read: Diagnosis = serde_json::from_str(EXAMPLE).expect("the example");
        assert!(read.effects[0].ambiguous_with.is_empty());
        assert_eq!(serde_json::to_value(&read).expect("JSON")["effects"][0]["ambiguous_with"], serde_json::json!([]));
        read.effects[0].ambiguous_with = ["rate", "crosstalk"].map(str::to_owned).to_vec();
        let written = serde_json::to_value(&read).expect("JSON");
        assert_eq!(written["effects"][0]["ambiguous_with"], serde_json::json!(["rate", "crosstalk"]));
        assert_eq!(serde_json::from_value::<Diagnosis>(written).expect("what was written"), read);
    }

    /// Everything that is expected is there; there may be more.
    fn assert_contains(written: &serde_json::Value, expected: &serde_json::Value, place: &str) {
        match expected {
            serde_json::Value::Object(fields) => {
                for (name, field) in fields {
                    let found = written.get(name).unwrap_or_else(|| panic!("{place}.{name} is missing"));
                    assert_contains(found, field, &format!("{place}.{name}"));
                }
            }
            serde_json::Value::Array(entries) => {
                assert_eq!(written.as_array().map(Vec::len), Some(entries.len()), "{place}");
                for (index, entry) in entries.iter().enumerate() {
                    assert_contains(&written[index], entry, &format!("{place}[{index}]"));
                }
            }
            _ => assert_eq!(written, expected, "{place}"),
        }
    }
}
