//! What a run found.

use kapvik_firmware::soil::{QueryAnswer, Refusal, SoilEstimate};

use crate::data::campaign::Campaign;
use crate::identify::{Identification, IdentifiedRun, Question, network_refusal};

use super::draw::number;
use super::facts::FlightFacts;
use super::residual::ModelCheck;

/// Everything that the report shows.
#[derive(Debug, Clone)]
pub struct Findings {
    /// What was measured.
    pub campaign: Campaign,
    /// What the flight computer made of it.
    pub identification: Identification,
    /// How the equations with the directly measured soil compare with the measurements; none where it is not known.
    pub model: Option<ModelCheck>,
    /// What is told of the flight computer.
    pub flight: FlightFacts,
}

/// Which network an estimate comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowKind {
    /// The per-wheel network, one wheel.
    Wheel,
    /// The rover network without sinkage.
    RoverWithoutSinkage,
    /// The rover network, with sinkage.
    RoverWithSinkage,
}

/// One estimate, with what it is of.
#[derive(Debug, Clone, PartialEq)]
pub struct EstimateRow {
    /// What it is of, in two words.
    pub label: String,
    /// The network.
    pub kind: RowKind,
    /// The estimate, or why there is none.
    pub estimate: Result<SoilEstimate, &'static str>,
    /// Whether a soil explains its run, or none has been looked for.
    pub is_explained: bool,
}

impl Findings {
    /// Every estimate of a run: wheel by wheel, then all wheels together.
    pub fn rows(run: &IdentifiedRun) -> Vec<EstimateRow> {
        let Some(question) = &run.question else { return Vec::new() };
        let is_explained = run.misfit.is_none();
        let wheels = question.query.wheels.iter().zip(&question.answer.wheels).map(|(state, answer)| EstimateRow {
            label: format!("slip {}", number(state.slip.into(), 2, false)),
            kind: RowKind::Wheel,
            estimate: worded(answer),
            is_explained,
        });
        wheels.chain(rover_rows(question, is_explained)).collect()
    }

    /// The best that there is of a run: all wheels together, with sinkage where it was measured.
    pub fn best(run: &IdentifiedRun) -> Option<EstimateRow> {
        Self::rows(run).pop()
    }
}

fn rover_rows(question: &Question, is_explained: bool) -> Vec<EstimateRow> {
    let wheels = question.query.wheels.len();
    let together = if wheels == 1 { "the one".to_owned() } else { format!("all {wheels}") };
    let row = |label: String, kind, answer: &QueryAnswer| {
        let estimate = worded(&answer.rover);
        EstimateRow { label, kind, estimate, is_explained }
    };
    match &question.answer_without_sinkage {
        Some(blind) => vec![
            row(together.clone(), RowKind::RoverWithoutSinkage, blind),
            row(format!("{together}, with z"), RowKind::RoverWithSinkage, &question.answer),
        ],
        None => vec![row(together, RowKind::RoverWithoutSinkage, &question.answer)],
    }
}

fn worded(answer: &Result<SoilEstimate, Refusal>) -> Result<SoilEstimate, &'static str> {
    answer.map_err(network_refusal)
}

/// A checksum over the bits of all answers, eight hexadecimal digits: two computers that print the same gave the same.
///
/// # Errors
/// Never in practice: an answer always fits its message.
pub fn fingerprint(answers: &[QueryAnswer]) -> Result<String, postcard::Error> {
    let bytes = postcard::to_stdvec(answers)?;
    Ok(format!("{:08x}", kapvik_firmware::checksum::Checksum::of(&bytes)))
}
