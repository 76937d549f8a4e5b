//! What `identify` prints: JSON.

use std::collections::BTreeMap;

use kapvik_firmware::soil::{ParameterEstimate, QueryAnswer, SoilEstimate};
use serde::Serialize;

use crate::data::campaign::{Campaign, Channel, Provenance};
use crate::train::prior::{self, Range};

use super::network::{Identification, IdentifiedRun, Question, at_edge, refusal_in_words};
use super::sensor_noise::{ChannelStd, NoiseSource, SensorNoise};

/// A campaign, identified.
#[derive(Debug, Clone, Serialize)]
pub struct Document {
    method: &'static str,
    campaign: String,
    kind: Provenance,
    source: String,
    /// Effects that the campaign declares. The networks know none.
    declared: Vec<String>,
    warnings: Vec<String>,
    /// Of one row, by channel.
    noise: BTreeMap<&'static str, NoiseDocument>,
    runs: Vec<RunDocument>,
}

/// One standard deviation of one row.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct NoiseDocument {
    std: f64,
    from: NoiseSource,
}

/// A run, identified.
#[derive(Debug, Clone, Serialize)]
pub struct RunDocument {
    run: String,
    refused: Option<String>,
    condition_number: Option<f64>,
    #[serde(flatten)]
    soil: SoilDocument,
    /// Whether the estimate used the sinkage.
    sinkage_used: bool,
    instants: usize,
    rows_used: usize,
    rows_left_out: Vec<LeftOutDocument>,
    /// The same without sinkage; null where there was none to leave out.
    without_sinkage: Option<SoilDocument>,
    wheels: Vec<WheelDocument>,
}

/// A row that was not used.
#[derive(Debug, Clone, Serialize)]
pub struct LeftOutDocument {
    line: u64,
    reason: String,
}

/// A soil; null in everything where there is no estimate.
#[derive(Debug, Clone, Default, Serialize)]
pub struct SoilDocument {
    cohesion_pa: Option<ParameterDocument>,
    friction_angle_rad: Option<ParameterDocument>,
    shear_modulus_m: Option<ParameterDocument>,
    outside_training_range: Option<bool>,
}

/// One parameter.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct ParameterDocument {
    value: f32,
    std: f32,
    identifiable: bool,
    /// At the end of what the networks were trained for, beyond which they cannot go: to be doubted, however narrow.
    at_edge_of_training: bool,
    interval_68: [f32; 2],
    interval_95: [f32; 2],
}

/// One wheel, identified by itself.
#[derive(Debug, Clone, Serialize)]
pub struct WheelDocument {
    slip: f64,
    load_n: f64,
    drawbar_pull_n: f64,
    torque_nm: f64,
    sinkage_m: Option<f64>,
    /// Rows in the mean.
    rows: usize,
    refused: Option<&'static str>,
    #[serde(flatten)]
    soil: SoilDocument,
}

impl Document {
    /// What is printed of an identification by the networks.
    pub fn of(campaign: &Campaign, identification: &Identification) -> Self {
        let declared = campaign.declared.ids();
        let mut warnings = Vec::new();
        if !declared.is_empty() {
            let effects = declared.join(", ");
            warnings.push(format!("declared effects that the networks were not trained with: {effects}"));
        }
        Self {
            method: "network",
            campaign: campaign.name.clone(),
            kind: campaign.provenance,
            source: campaign.source.clone(),
            declared,
            warnings,
            noise: noise(&identification.noise),
            runs: identification.runs.iter().map(RunDocument::of).collect(),
        }
    }
}

fn noise(noise: &SensorNoise) -> BTreeMap<&'static str, NoiseDocument> {
    let entry = |channel: Channel, std: ChannelStd| (channel.name(), NoiseDocument { std: std.std, from: std.source });
    BTreeMap::from([
        entry(Channel::DrawbarPull, noise.drawbar_pull),
        entry(Channel::Load, noise.load),
        entry(Channel::Torque, noise.torque),
        entry(Channel::Slip, noise.slip),
        entry(Channel::Sinkage, noise.sinkage),
    ])
}

impl RunDocument {
    fn of(run: &IdentifiedRun) -> Self {
        let question = run.question.as_ref();
        let estimate = |answer: &QueryAnswer| answer.rover.as_ref().map(SoilDocument::of).unwrap_or_default();
        Self {
            run: run.run.clone(),
            refused: run.refused(),
            condition_number: question.and_then(|question| question.condition_number),
            soil: question.map(|question| estimate(&question.answer)).unwrap_or_default(),
            sinkage_used: question.is_some_and(Question::sinkage_used),
            instants: run.instants,
            rows_used: run.rows_used,
            rows_left_out: run
                .rows_left_out
                .iter()
                .map(|(line, reason)| LeftOutDocument { line: *line, reason: reason.clone() })
                .collect(),
            without_sinkage: question.and_then(|question| question.answer_without_sinkage.as_ref()).map(estimate),
            wheels: question.map(WheelDocument::all).unwrap_or_default(),
        }
    }
}

impl WheelDocument {
    fn all(question: &Question) -> Vec<Self> {
        let wheels = question.states.iter().zip(&question.answer.wheels);
        wheels
            .map(|(state, answer)| Self {
                slip: state.mean.slip,
                load_n: state.mean.load_n,
                drawbar_pull_n: state.mean.drawbar_pull_n,
                torque_nm: state.mean.torque_nm,
                sinkage_m: state.mean.sinkage_m,
                rows: state.rows,
                refused: answer.as_ref().err().map(|refusal| refusal_in_words(*refusal)),
                soil: answer.as_ref().map(SoilDocument::of).unwrap_or_default(),
            })
            .collect()
    }
}

impl SoilDocument {
    fn of(estimate: &SoilEstimate) -> Self {
        Self {
            cohesion_pa: Some(ParameterDocument::of(&estimate.cohesion_pa, prior::COHESION_PA)),
            friction_angle_rad: Some(ParameterDocument::of(&estimate.friction_angle_rad, prior::FRICTION_ANGLE_RAD)),
            shear_modulus_m: Some(ParameterDocument::of(&estimate.shear_modulus_m, prior::SHEAR_MODULUS_M)),
            outside_training_range: Some(estimate.outside_training_range),
        }
    }
}

impl ParameterDocument {
    fn of(estimate: &ParameterEstimate, trained: Range) -> Self {
        Self {
            value: estimate.value,
            std: estimate.std,
            identifiable: estimate.identifiable,
            at_edge_of_training: at_edge(trained, estimate.value.into()),
            interval_68: estimate.interval_68,
            interval_95: estimate.interval_95,
        }
    }
}
