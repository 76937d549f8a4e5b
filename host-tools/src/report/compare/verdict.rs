//! What follows from a comparison, in sentences.

use crate::compare::{CONTENDERS, Compared, Comparison, Score, is_beaten};
use crate::parameter::Parameter;
use crate::report::draw::number;

use super::terminal::label;

/// Who answers less often, or says more often of its answer that the data do not tell it, has no say: the middle of the prior
/// is near a truth that lies there, whatever was seen.
const LEAST_TOLD: f64 = 0.5;

/// Whether a method has the least median error of those that claim to tell the parameter, told no more than the others.
pub fn is_best(compared: &Compared, score: &Score, parameter: Parameter) -> bool {
    winner(compared, parameter).is_some_and(|best| best.contender == score.contender)
}

/// Whether a method is told no more than the others.
pub fn is_in_contest(score: &Score) -> bool {
    !CONTENDERS.iter().any(|contender| contender.id == score.contender && contender.is_told_otherwise())
}

fn winner(compared: &Compared, parameter: Parameter) -> Option<&Score> {
    let contests = |score: &&Score| {
        let of = score.parameter(parameter);
        score.contender != "limit"
            && is_in_contest(score)
            && !of.assumed
            && (1.0 - score.refused) * of.identifiable >= LEAST_TOLD
    };
    let error = |score: &Score| score.parameter(parameter).median_error;
    compared.scores.iter().filter(contests).min_by(|a, b| error(a).total_cmp(&error(b)))
}

/// Who wins where.
pub fn verdicts(comparison: &Comparison) -> Vec<String> {
    Parameter::ALL.into_iter().filter_map(|parameter| wins(comparison, parameter)).collect()
}

/// How near the methods come to the limit: situation, method, and the ratios of c, φ and K. The nearest methods alone.
pub fn to_limit(comparison: &Comparison) -> Vec<[String; 5]> {
    const NEAREST: [&str; 2] = ["map", "network"];
    let of = |compared: &Compared| -> Vec<[String; 5]> {
        let near = compared.to_limit.iter().filter(|one| NEAREST.contains(&one.contender));
        near.map(|one| {
            let [c, phi, k] = one.ratio.map(|ratio| number(ratio, 2, false));
            [compared.id.to_owned(), label(one.contender).to_owned(), c, phi, k]
        })
        .collect()
    };
    comparison.situations.iter().flat_map(of).collect()
}

fn wins(comparison: &Comparison, parameter: Parameter) -> Option<String> {
    let told = |compared: &&Compared| compared.model_is_right && winner(compared, parameter).is_some();
    if !comparison.situations.iter().any(|compared| compared.model_is_right) {
        return None;
    }
    let told: Vec<&Compared> = comparison.situations.iter().filter(told).collect();
    if told.is_empty() {
        return Some(format!("{}: no method tells it in any situation", parameter.symbol()));
    }
    let lost = |soils_differ: bool| -> Vec<String> {
        let among = told.iter().filter(|compared| compared.soils_differ == soils_differ);
        among.filter_map(|compared| loss(compared, parameter)).collect()
    };
    let ranked = told.iter().filter(|compared| compared.soils_differ).count();
    let (lost, lost_one_soil) = (lost(true), lost(false));
    let mut clauses = Vec::new();
    if ranked > 0 {
        clauses.push(format!(
            "no method that claims to tell it has a median error below that of map, beyond the chance of the cases drawn, in \
             {} of {ranked} situations in which the model is right, soils differ and some method tells it",
            ranked - lost.len()
        ));
    }
    if !lost.is_empty() {
        clauses.push(format!("but {}", lost.join("; ")));
    }
    if !lost_one_soil.is_empty() {
        clauses.push(format!("where the soil is always the same, which ranks nobody, {}", lost_one_soil.join("; ")));
    }
    (!clauses.is_empty()).then(|| format!("{}: {}", parameter.symbol(), clauses.join("; ")))
}

fn loss(compared: &Compared, parameter: Parameter) -> Option<String> {
    let best = winner(compared, parameter)?;
    let digits = 2 * parameter.decimals();
    let error = |score: &Score| number(score.parameter(parameter).median_error, digits, false);
    let map = compared.scores.iter().find(|score| score.contender == "map")?;
    if best.contender == "map" || !is_beaten(map.parameter(parameter), best.parameter(parameter)) {
        return None;
    }
    Some(format!("{} in {} ({} against {})", label(best.contender), compared.id, error(best), error(map)))
}
