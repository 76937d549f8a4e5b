//! Every method on the same data: error, interval, bias, refusals and cost.

mod bound;
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
use crate::parameter::Parameter;

pub use case::{Case, case};
pub use contender::{CONTENDERS, Contender};
pub use measured::{MeasuredRow, measured};
pub use score::{ParameterScore, Score, Timed, is_beaten};
pub use situation::{SITUATIONS, SLIPS, Situation, SlipSinkage, Truth};

/// What is to be compared.
#[derive(Debug, Clone)]
pub struct CompareOptions {
    /// Cases of each situation.
    pub cases: usize,
    /// Of soils, loads and noise.
    pub seed: u64,
    /// Cases of each situation that the limit is sampled for: seconds each.
    pub limit_cases: usize,
    /// Situations by name; none means all.
    pub only: Vec<String>,
    /// Contenders by name; none means all.
    pub contenders: Vec<&'static str>,
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
    /// Whether the soil differs from case to case; one soil ranks no methods.
    pub soils_differ: bool,
    /// What no unbiased estimator can beat, where nothing is believed of c (Pa), φ (°) and K (mm): root mean square. None where the soil does
    /// what equations 1–11 lack, for which it is not computed.
    pub cramer_rao: Option<[f64; 3]>,
    /// Contender by contender.
    pub scores: Vec<Score>,
    /// Root mean square errors over those of the limit, on the cases that it was sampled for.
    pub to_limit: Vec<ToLimit>,
}

/// How near a contender is to the limit.
#[derive(Debug, Clone, Serialize)]
pub struct ToLimit {
    /// The contender.
    pub contender: &'static str,
    /// Of c, φ and K: root mean square error over that of the limit on the same cases.
    pub ratio: [f64; 3],
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
    /// How many answers there are to wait for.
    ///
    /// # Errors
    /// At a situation that there is not.
    pub fn answers(&self) -> Result<usize, HostError> {
        let of = |situation: &&Situation| {
            let cases = |contender: &Contender| {
                if contender.is_limit() { self.limit_cases.min(self.cases) } else { self.cases }
            };
            self.contenders_in(situation).map(cases).sum::<usize>()
        };
        Ok(self.situations()?.iter().map(of).sum())
    }

    /// Those of the contenders asked for that take part in a situation.
    fn contenders_in(&self, situation: &Situation) -> impl Iterator<Item = &'static Contender> {
        let is_asked_for =
            |contender: &Contender| self.contenders.is_empty() || self.contenders.contains(&contender.id);
        CONTENDERS.iter().filter(move |contender| is_asked_for(contender) && contender.takes_part(situation))
    }

    /// The situations that are asked for.
    ///
    /// # Errors
    /// At one that there is not.
    pub fn situations(&self) -> Result<Vec<&'static Situation>, HostError> {
        if self.only.is_empty() {
            return Ok(SITUATIONS.iter().collect());
        }
        if let Some(id) = self.only.iter().find(|id| Situation::find(id).is_none()) {
            let ids: Vec<_> = SITUATIONS.iter().map(|situation| situation.id).collect();
            return Err(HostError::Failed(format!("no situation `{id}`: expected one of {}", ids.join(", "))));
        }
        let is_asked_for = |situation: &&Situation| self.only.iter().any(|id| id == situation.id);
        Ok(SITUATIONS.iter().filter(is_asked_for).collect())
    }
}

fn compared(situation: &Situation, options: &CompareOptions, done: &(impl Fn() + Sync)) -> Compared {
    let cases: Vec<Case> =
        (0..options.cases).into_par_iter().filter_map(|place| case(situation, options.seed, place)).collect();
    let truths: Vec<Soil<f64>> = cases.iter().map(|case| case.soil).collect();
    let limit_cases = options.limit_cases.min(cases.len());
    let answers: Vec<(&Contender, Vec<Timed>)> = options
        .contenders_in(situation)
        .map(|contender| {
            let asked = if contender.is_limit() { &cases[..limit_cases] } else { &cases };
            (contender, asked.par_iter().map(|case| timed(contender, case, done)).collect())
        })
        .collect();
    let score = |(contender, timed): &(&Contender, Vec<Timed>)| Score::of(contender.id, &truths, timed);
    Compared {
        id: situation.id,
        title: situation.title,
        model_is_right: situation.model_is_right(),
        soils_differ: situation.soils_differ(),
        cramer_rao: situation.obeys_equations().then(|| bound::cramer_rao(&cases)).flatten(),
        to_limit: to_limit(&truths[..limit_cases], &answers),
        scores: answers.iter().map(score).collect(),
    }
}

fn timed(contender: &Contender, case: &Case, done: &(impl Fn() + Sync)) -> Timed {
    let started = Instant::now();
    let found = contender.answer(case);
    let seconds = started.elapsed().as_secs_f64();
    done();
    Timed { found, seconds }
}

/// Of every contender that answers all the cases that the limit does.
fn to_limit(truths: &[Soil<f64>], answers: &[(&Contender, Vec<Timed>)]) -> Vec<ToLimit> {
    let rmse = |timed: &[Timed]| {
        let score = Score::of("", truths, &timed[..truths.len()]);
        (score.refused == 0.0).then(|| Parameter::ALL.map(|parameter| score.parameter(parameter).rmse))
    };
    let limit = answers.iter().find(|(contender, _)| contender.is_limit()).and_then(|(_, timed)| rmse(timed));
    let Some(limit) = limit else { return Vec::new() };
    let ratio = |(contender, timed): &(&Contender, Vec<Timed>)| {
        let own = rmse(timed)?;
        Some(ToLimit { contender: contender.id, ratio: std::array::from_fn(|k| own[k] / limit[k]) })
    };
    answers.iter().filter(|(contender, _)| !contender.is_limit()).filter_map(ratio).collect()
}
