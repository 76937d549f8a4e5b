//! What follows from a comparison, in sentences.

use crate::compare::{Compared, Comparison, Parameter, Score};
use crate::report::draw::number;

use super::terminal::label;

/// Methods that are told what nobody knows on a drive: they stand in the table, but they are not in the contest.
const TOLD_THE_TRUTH: [&str; 3] = ["iagnemma-K", "iagnemma-recursive", "hutangkabodee-n"];
/// Fewer answered cases than this and a median error is no argument.
const LEAST_ANSWERED: f64 = 0.5;

/// Whether a method has the least median error of those that answer, told no more than the others.
pub fn is_best(compared: &Compared, score: &Score, parameter: Parameter) -> bool {
    winner(compared, parameter).is_some_and(|best| best.contender == score.contender)
}

fn winner(compared: &Compared, parameter: Parameter) -> Option<&Score> {
    let contests = |score: &&Score| {
        let of = score.parameter(parameter);
        score.contender != "limit"
            && !TOLD_THE_TRUTH.contains(&score.contender)
            && !of.assumed
            && of.median_error.is_finite()
            && score.refused <= LEAST_ANSWERED
    };
    let error = |score: &Score| score.parameter(parameter).median_error;
    compared.scores.iter().filter(contests).min_by(|a, b| error(a).total_cmp(&error(b)))
}

/// Who wins where, and how near the network is to the limit.
pub fn verdicts(comparison: &Comparison) -> Vec<String> {
    let mut verdicts = Vec::new();
    for parameter in Parameter::ALL {
        verdicts.extend(wins(comparison, parameter));
    }
    for parameter in Parameter::ALL {
        verdicts.extend(comparison.situations.iter().filter_map(|compared| to_limit(compared, parameter)));
    }
    verdicts
}

fn wins(comparison: &Comparison, parameter: Parameter) -> Option<String> {
    let right: Vec<&Compared> = comparison.situations.iter().filter(|compared| compared.model_is_right).collect();
    if right.is_empty() {
        return None;
    }
    let lost: Vec<String> = right.iter().filter_map(|compared| loss(compared, parameter)).collect();
    let won = right.len() - lost.len();
    let mut text = format!(
        "{}: map has the least median error in {won} of {} situations in which the model is right",
        symbol(parameter),
        right.len()
    );
    if !lost.is_empty() {
        text += &format!("; otherwise {}", lost.join("; "));
    }
    Some(text)
}

fn loss(compared: &Compared, parameter: Parameter) -> Option<String> {
    let best = winner(compared, parameter)?;
    if best.contender == "map" {
        return None;
    }
    let digits = usize::from(parameter != Parameter::Cohesion) * 2;
    let error = |score: &Score| number(score.parameter(parameter).median_error, digits, false);
    let map = compared.scores.iter().find(|score| score.contender == "map")?;
    Some(format!("{} in {} ({} against {})", label(best.contender), compared.id, error(best), error(map)))
}

fn to_limit(compared: &Compared, parameter: Parameter) -> Option<String> {
    let of = |id: &str| {
        compared.scores.iter().find(|score| score.contender == id).map(|score| score.parameter(parameter).rmse)
    };
    let limit = of("limit")?;
    let ratio = |id| Some(number(of(id)? / limit, 2, false));
    Some(format!(
        "{}, {}: root mean square error over that of the limit: map {}, rover network {}",
        symbol(parameter),
        compared.id,
        ratio("map")?,
        ratio("network")?
    ))
}

/// The letter of a parameter.
pub fn symbol(parameter: Parameter) -> &'static str {
    match parameter {
        Parameter::Cohesion => "c",
        Parameter::FrictionAngle => "φ",
        Parameter::ShearModulus => "K",
    }
}
