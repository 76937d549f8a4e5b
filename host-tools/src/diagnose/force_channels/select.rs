//! Which terms a force channel follows: one after the other, the best on runs that the fit did not know first.

use std::collections::BTreeMap;

use kapvik_firmware::terramechanics::effects::effect_info;
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::super::chance::over_all;
use super::super::document::{Estimate, FoundEffect};
use super::super::selection::{BEYOND_DOUBT, TELLS_APART};
use super::super::unseen_runs::summed;
use super::ForceChannel;
use super::jackknife::{Jackknife, first_stage_strength};
use super::regression::{Problem, Term};

/// The chance, over all terms, below which one is taken for an effect. Less than where forces are fitted by equations: here a
/// straight line stands for whatever a sensor may do, and the other channels look at the same runs.
const SIGNIFICANT: f64 = 0.005;
/// Terms that are added at most.
const MOST_TERMS: usize = 4;
/// Runs beyond the coefficients, below which nothing is said.
const LEAST_DEGREES: f64 = 4.0;
/// F statistic of the first stage below which instruments are weak: Staiger & Stock 1997, Econometrica 65(3).
const LEAST_STRENGTH: f64 = 10.0;
/// Standard errors by which the gain on runs that were not seen must exceed nothing.
const HELD_OUT_ERRORS: f64 = 1.0;

/// A term, tried.
struct Tried<'a> {
    term: &'a Term,
    /// Chance, over all terms that were tried.
    p_value: f64,
    /// Gain in ln probability of held-out runs, in all.
    gain: f64,
    /// One standard deviation of that, over runs.
    gain_std: f64,
    /// Other effects that these readings do not tell from it.
    not_told_from: Vec<&'static str>,
}

impl Tried<'_> {
    fn is_significant(&self) -> bool {
        let errors = if self.p_value < BEYOND_DOUBT { 0.0 } else { HELD_OUT_ERRORS };
        self.p_value < SIGNIFICANT && self.gain > errors * self.gain_std
    }
}

/// The terms of a channel beyond chance; `tried` terms make up the family that chance chooses from.
pub fn select(problem: &Problem, tried: usize) -> ForceChannel {
    let mut chosen: Vec<Tried<'_>> = Vec::new();
    let mut caveats = Vec::new();
    let mut step = significant(problem, &[], tried);
    while chosen.len() < MOST_TERMS && !step.is_empty() {
        step.sort_by(|a, b| b.gain.total_cmp(&a.gain));
        let mut best = step.remove(0);
        let beside: Vec<&Term> = chosen.iter().map(|tried| tried.term).chain([best.term]).collect();
        let left = significant(problem, &beside, tried);
        let is_rival = |other: &&Tried<'_>| {
            best.gain - other.gain < TELLS_APART && !left.iter().any(|tried| std::ptr::eq(tried.term, other.term))
        };
        let rivals: Vec<&Term> = step.iter().filter(is_rival).map(|other| other.term).collect();
        if !rivals.is_empty() {
            caveats.push(not_told_apart(problem, best.term, &rivals));
        }
        best.not_told_from = other_effects(best.term, &rivals);
        chosen.push(best);
        step = left;
    }
    ForceChannel { channel: problem.channel, effects: effects(problem, &chosen), caveats }
}

/// The ids of terms that are of another effect, each once.
fn other_effects(best: &Term, rivals: &[&Term]) -> Vec<&'static str> {
    let mut ids: Vec<&'static str> = Vec::new();
    for rival in rivals {
        if rival.id != best.id && !ids.contains(&rival.id) {
            ids.push(rival.id);
        }
    }
    ids
}

fn not_told_apart(problem: &Problem, best: &Term, rivals: &[&Term]) -> String {
    let rivals: Vec<String> = rivals.iter().map(|rival| rival.words()).collect();
    format!(
        "Force channels by themselves: {} follows {} best, but these readings do not tell that from {}.",
        problem.channel.name(),
        best.words(),
        rivals.join(" or ")
    )
}

/// The terms that chance does not explain beside those that are in.
fn significant<'a>(problem: &'a Problem, chosen: &[&Term], tried: usize) -> Vec<Tried<'a>> {
    let Some(base) = Jackknife::fit(problem, chosen) else { return Vec::new() };
    let others = problem.terms.iter().filter(|term| !chosen.iter().any(|other| std::ptr::eq(*other, *term)));
    let examine = |term: &'a Term| {
        let strong = !term.by_instruments || first_stage_strength(problem, chosen, term) > LEAST_STRENGTH;
        let terms: Vec<&Term> = chosen.iter().copied().chain([term]).collect();
        let fit = strong.then(|| Jackknife::fit(problem, &terms)).flatten()?;
        let (value, std) = (*fit.coefficients.last()?, *fit.std.last()?);
        let p_value = chance(value / std, fit.degrees_of_freedom, tried)?;
        let gains: Vec<f64> =
            base.log_scores.iter().zip(&fit.log_scores).map(|(before, after)| after - before).collect();
        let (gain, gain_std) = summed(&gains);
        is_sensible(term, value).then_some(Tried { term, p_value, gain, gain_std, not_told_from: Vec::new() })
    };
    others.filter_map(examine).filter(Tried::is_significant).collect()
}

/// The chance that the largest of `tried` t statistics of nothing is so large (Šidák).
fn chance(t: f64, degrees_of_freedom: f64, tried: usize) -> Option<f64> {
    if !t.is_finite() || degrees_of_freedom < LEAST_DEGREES {
        return None;
    }
    let alone = 2.0 * StudentsT::new(0.0, 1.0, degrees_of_freedom).ok()?.sf(t.abs());
    Some(over_all(alone, tried))
}

/// Whether a parameter lies where the catalogue says that it makes sense.
fn is_sensible(term: &Term, value: f64) -> bool {
    let parameter = effect_info(term.id).and_then(|info| info.parameter(term.parameter));
    parameter.is_some_and(|parameter| (parameter.low..=parameter.high).contains(&value))
}

/// What was chosen, with the values of all in one fit.
fn effects(problem: &Problem, chosen: &[Tried<'_>]) -> Vec<FoundEffect> {
    let terms: Vec<&Term> = chosen.iter().map(|tried| tried.term).collect();
    let Some(fit) = Jackknife::fit(problem, &terms) else { return Vec::new() };
    let entry = |(place, tried): (usize, &Tried<'_>)| {
        let estimate = Estimate { value: fit.coefficients[place], std: fit.std[place] };
        FoundEffect {
            id: tried.term.id.to_owned(),
            form: tried.term.form.to_owned(),
            parameters: BTreeMap::from([(tried.term.parameter.to_owned(), estimate)]),
            gain_per_row: tried.gain / problem.rows() as f64,
            p_value: tried.p_value,
            ambiguous_with: tried.not_told_from.iter().map(|id| (*id).to_owned()).collect(),
        }
    };
    chosen.iter().enumerate().map(entry).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_form_of_an_effect_is_no_other_effect() {
        let term = |id, form| Term { id, form, parameter: "load_n_per_h", values: Vec::new(), by_instruments: false };
        let [best, warm] = ["load with hours", "load with temperature"].map(|form| term("force-drift", form));
        let leaks = ["drawbar pull into load", "torque into load"].map(|form| term("crosstalk", form));
        let rivals = [&leaks[0], &warm, &leaks[1]];
        assert_eq!(other_effects(&best, &rivals), ["crosstalk"]);
        assert!(other_effects(&best, &[]).is_empty());
    }
}
