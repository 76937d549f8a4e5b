//! Every method on the same data: error, interval, bias, refusals and cost.

mod case;
mod contender;
mod measured;
mod score;
mod situation;

use std::time::Instant;

use kapvik_firmware::terramechanics::Soil;
use rayon::prelude::*;
use serde::Serialize;

use crate::error::HostError;

pub use case::{Case, case};
pub use contender::{CONTENDERS, Contender};
pub use measured::{MeasuredRow, measured};
pub use score::{Parameter, ParameterScore, Score, Timed};
pub use situation::{SITUATIONS, Situation, SlipSinkage, Truth};

/// What is to be compared.
#[derive(Debug, Clone)]
pub struct CompareOptions {
    /// Cases of each situation.
    pub cases: usize,
    /// Of soils, loads and noise.
    pub seed: u64,
    /// Situations by name; none means all.
    pub only: Vec<String>,
}

/// The table.
#[derive(Debug, Clone, Serialize)]
pub struct Comparison {
    /// Cases of each situation.
    pub cases: usize,
    /// Of soils, loads and noise.
    pub seed: u64,
    /// The situations in which the truth is known because it was made.
    pub situations: Vec<Compared>,
    /// The measured figures, whose soil direct tests know.
    pub measured: Vec<MeasuredRow>,
}

/// One situation.
#[derive(Debug, Clone, Serialize)]
pub struct Compared {
    /// Its short name.
    pub id: &'static str,
    /// In words.
    pub title: &'static str,
    /// Whether the methods' equations made the data.
    pub model_is_right: bool,
    /// Contender by contender.
    pub scores: Vec<Score>,
}

/// Sets every contender before every situation. `done` is called after each answer to a case.
///
/// # Errors
/// At a situation that there is not.
pub fn compare(options: &CompareOptions, done: &(impl Fn() + Sync)) -> Result<Comparison, HostError> {
    let situations = options.situations()?;
    let measured = if options.only.is_empty() { measured()? } else { Vec::new() };
    let situations = situations.into_iter().map(|situation| compared(situation, options, done)).collect();
    Ok(Comparison { cases: options.cases, seed: options.seed, situations, measured })
}

impl CompareOptions {
    /// The situations that are asked for.
    ///
    /// # Errors
    /// At one that there is not.
    pub fn situations(&self) -> Result<Vec<&'static Situation>, HostError> {
        if self.only.is_empty() {
            return Ok(SITUATIONS.iter().collect());
        }
        let find = |id: &String| {
            Situation::find(id).ok_or_else(|| {
                let ids: Vec<_> = SITUATIONS.iter().map(|situation| situation.id).collect();
                HostError::Failed(format!("no situation `{id}`: expected one of {}", ids.join(", ")))
            })
        };
        self.only.iter().map(find).collect()
    }
}

fn compared(situation: &Situation, options: &CompareOptions, done: &(impl Fn() + Sync)) -> Compared {
    let cases: Vec<Case> =
        (0..options.cases).into_par_iter().filter_map(|place| case(situation, options.seed, place)).collect();
    let truths: Vec<Soil<f64>> = cases.iter().map(|case| case.soil).collect();
    // The limit's prior is that of the networks, and it knows equations 1–11.
    let has_limit = situation.truth == Truth::Drawn && situation.slip_sinkage == SlipSinkage::None;
    let scores = CONTENDERS.iter().filter(|contender| has_limit || !contender.is_limit()).map(|contender| {
        let answers: Vec<Timed> = cases
            .par_iter()
            .map(|case| {
                let started = Instant::now();
                let found = contender.answer(case);
                let seconds = started.elapsed().as_secs_f64();
                done();
                Timed { found, seconds }
            })
            .collect();
        Score::of(contender.id, &truths, &answers)
    });
    Compared {
        id: situation.id,
        title: situation.title,
        model_is_right: situation.model_is_right(),
        scores: scores.collect(),
    }
}
