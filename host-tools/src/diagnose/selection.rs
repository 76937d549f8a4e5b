//! Which effect a model lacks: every candidate refitted with the model, ranked, and tested against chance.

use rayon::prelude::*;

use super::bench::{Bench, Glance};
use super::candidates::candidates;
use super::fit::HeldOutRun;
use super::gain_chance::Gain;
use super::specification::EffectForm;
use super::trial::Trial;
use super::unseen_runs::{HeldOutGain, held_out, nearly_held_out};

/// The chance, over all candidates, below which a gain is taken for an effect: less than half of the false alarms that are
/// allowed, for they come of structure that no effect explains as well.
pub const SIGNIFICANT: f64 = 0.02;
/// What a free parameter must gain in ln likelihood to be worth itself.
pub const PARAMETER_COST: f64 = 1.5;
/// Difference in ln likelihood below which two candidates are not told apart: odds of one to twenty.
pub const TELLS_APART: f64 = 3.0;
/// Dispersion beyond which the data are not explained.
pub const MISFIT: f64 = 1.5;
/// Candidates on top of which a second effect is tried to see how far the data can be explained.
const LEADERS: usize = 4;
/// Second effects that are fitted on top of each of these.
const SECONDS: usize = 3;
/// Candidates that are fitted to the end.
const FINISHED: usize = 6;
/// Difference in ln likelihood from the best beyond which none of them is in question.
pub const IN_QUESTION: f64 = 15.0;
/// Share of the best gain in ln posterior at a short look, and how much less than that, from which a candidate may still lead.
const PROMISING_SHARE: f64 = 0.5;
const PROMISING_LESS: f64 = 10.0;
/// The chance below which any gain on runs that were not seen is enough.
pub const BEYOND_DOUBT: f64 = 1e-4;
/// The chance below which an effect must be of a size that is beyond doubt, too; and the standard deviations that are.
const BY_FAR: f64 = 1e-6;
const NEUTRAL_ERRORS: f64 = 2.5;
/// Said of what gains on the runs that it sees, and not surely on others.
pub const NOT_SURELY_BETTER: &str = "it is not surely better on runs that its fit did not know";
/// Standard errors by which the gain on runs that were not seen must exceed nothing.
const HELD_OUT_ERRORS: f64 = 1.0;
/// The same where noise does not explain what is left in any case, so that chances are guesses.
const HELD_OUT_ERRORS_OF_A_MISFIT: f64 = 2.0;

/// A candidate, fitted and judged.
#[derive(Debug, Clone)]
pub struct Judged<'a> {
    /// The model with the candidate.
    pub trial: Trial<'a>,
    /// What it gains in ln likelihood over the model without, in units of the dispersion, less the cost of its parameters.
    pub score: f64,
    /// The chance of such a gain, over all candidates, in as many independent rows as there are.
    pub p_value: f64,
    /// The gain on runs that the fits did not see.
    pub held_out: HeldOutGain,
    /// Standard errors by which that gain must exceed nothing.
    pub errors_wanted: f64,
    /// Other forms of the effect that the data do not tell from this one.
    pub other_forms: Vec<&'static str>,
}

impl Judged<'_> {
    /// The candidate.
    pub fn effect(&self) -> Option<&EffectForm> {
        self.trial.added()
    }

    /// Its id.
    pub fn id(&self) -> &'static str {
        self.trial.added_id()
    }

    /// Whether chance does not explain it.
    pub fn is_significant(&self) -> bool {
        self.is_beyond_chance() && self.refusal().is_none()
    }

    /// What speaks against it beside chance.
    fn refusal(&self) -> Option<&'static str> {
        let errors = if self.p_value < BEYOND_DOUBT { 0.0 } else { self.errors_wanted };
        if !(self.held_out.exceeds(errors) && self.held_out.is_shared()) {
            return Some(NOT_SURELY_BETTER);
        }
        // Where a gain is beyond chance by far and the effect's size is not, the two do not speak of the same noise: estimated beside offsets
        // of whole runs, it may come out far too small.
        if self.p_value < BY_FAR && self.trial.may_be_neutral(NEUTRAL_ERRORS) {
            return Some("its size may be nothing");
        }
        self.trial.is_out_of_bounds().then_some("its size would lie out of its range")
    }

    /// Why it is no effect, where that is not that chance does as much.
    pub fn why_not(&self) -> Option<&'static str> {
        self.is_beyond_chance().then(|| self.refusal().unwrap_or("a bare column does what it does"))
    }

    /// Whether the data do not tell another from it. Both must leave it open: the likelihood of the runs that were seen, and the density of
    /// those that were not.
    pub fn is_near(&self, other: &Self) -> bool {
        let errors = self.held_out.std.hypot(other.held_out.std);
        other.score > self.score - TELLS_APART && other.held_out.per_row > self.held_out.per_row - errors
    }

    /// Whether chance does not explain what it gains, whether or not it may be the effect.
    pub fn is_beyond_chance(&self) -> bool {
        self.p_value < SIGNIFICANT
    }
}

/// What one step of the forward selection found: for each effect its best form, the best effect first.
#[derive(Debug, Clone)]
pub struct Step<'a> {
    /// The model that they were added to, at its best.
    pub base: Trial<'a>,
    /// The candidates.
    pub ranking: Vec<Judged<'a>>,
    /// The dispersion that gains are measured in, 1 or more.
    pub dispersion: f64,
    /// The best models with two more effects, looked for where one leaves the data far from explained.
    pub ahead: Vec<Trial<'a>>,
}

/// Fits the candidates on top of a model, and judges the best form of each effect.
pub fn step<'a>(bench: &Bench<'a>, base: &Trial<'a>) -> Step<'a> {
    let all = candidates(bench.campaign, bench.measurements, &base.specification);
    let trials = trials(bench, base, &all);
    let base = bench.finished(polished(bench, base, &trials));
    judged(bench, base, trials, all.len())
}

/// A step with the fit of one candidate exchanged for a better one that was found later.
pub fn with_better_fit<'a>(bench: &Bench<'a>, step: &Step<'a>, better: Trial<'a>) -> Step<'a> {
    let tried = candidates(bench.campaign, bench.measurements, &step.base.specification).len();
    let mut trials: Vec<_> = step.ranking.iter().map(|judged| judged.trial.clone()).chain([better]).collect();
    trials = best_forms(trials);
    trials.sort_by(|a, b| worth(b).total_cmp(&worth(a)));
    judged(bench, step.base.clone(), trials, tried)
}

/// Judges the fits of candidates, the best first, of which there were `tried`.
fn judged<'a>(bench: &Bench<'a>, base: Trial<'a>, trials: Vec<Trial<'a>>, tried: usize) -> Step<'a> {
    let misfit = is_misfit(trials.iter());
    let ahead = if misfit { look_ahead(bench, &trials) } else { Vec::new() };
    let dispersion = dispersion(&base, &trials, &ahead);
    let errors_wanted = if misfit { HELD_OUT_ERRORS_OF_A_MISFIT } else { HELD_OUT_ERRORS };
    let before = Before { exactly: held_out(bench, &base), nearly: nearly_held_out(bench, &base) };
    let enough = enough(&trials, dispersion);
    // What a second effect does along a run is no memory of noise.
    let of_noise = ahead.iter().map(|both| both.fit.rows_per_reading()).fold(f64::INFINITY, f64::min);
    let judge = |(place, trial): (usize, Trial<'a>)| {
        let is_exact = place < FINISHED && worth(&trial) > enough;
        let (before, after) = if is_exact {
            (&before.exactly, held_out(bench, &trial))
        } else {
            (&before.nearly, nearly_held_out(bench, &trial))
        };
        let held_out = HeldOutGain::over(before, &after);
        let rows_per_reading = trial.fit.rows_per_reading().min(of_noise);
        let gain = Gain { rows_per_reading, ..Gain::over(&base, &trial, dispersion) };
        let score = gain.in_dispersions() - PARAMETER_COST * trial.added_parameters() as f64;
        let p_value = gain.chance(trial.added_parameters(), tried);
        let judged = Judged { score, p_value, held_out, errors_wanted, trial, other_forms: Vec::new() };
        Predicted { judged, runs: after, is_exact }
    };
    let all = in_order(trials.into_par_iter().enumerate().map(judge).collect(), misfit);
    Step { base, ranking: best_forms_judged(all), dispersion, ahead }
}

/// Of each effect the best form, with those that the data do not tell from it.
fn best_forms_judged(all: Vec<Judged<'_>>) -> Vec<Judged<'_>> {
    let mut ranking: Vec<Judged<'_>> = Vec::new();
    for judged in all {
        match ranking.iter_mut().find(|best| best.id() == judged.id()) {
            Some(best) if best.is_near(&judged) && judged.is_significant() => {
                best.other_forms.extend(judged.effect().map(|effect| effect.form.name));
            }
            Some(_) => {}
            None => ranking.push(judged),
        }
    }
    ranking
}

/// What the model without any candidate says of runs that it has not seen.
struct Before {
    exactly: Vec<HeldOutRun>,
    nearly: Vec<HeldOutRun>,
}

/// A candidate, with what it says of runs that it has not seen.
struct Predicted<'a> {
    judged: Judged<'a>,
    runs: Vec<HeldOutRun>,
    /// Whether by fits without them; else to first order from the fit to all.
    is_exact: bool,
}

/// Candidates with their predictions of unseen runs, the best first; those that earn a place come before the others. An effect
/// that frees the right latents can fit the runs that it sees as well as the true one does. So the best by fit yields to those
/// that predict unseen runs better beyond chance, and where more than one effect is missing and a fit says little, to those that
/// predict them better at all. What is predicted to first order only outruns nobody: along a valley that bends such a step ends anywhere.
fn in_order(mut candidates: Vec<Predicted<'_>>, misfit: bool) -> Vec<Judged<'_>> {
    let significant = candidates.iter().filter(|candidate| candidate.judged.is_significant());
    let leader = significant.max_by(|a, b| a.judged.score.total_cmp(&b.judged.score));
    let leader = leader.map(|leader| leader.runs.clone());
    let place = |Predicted { judged, runs, is_exact }: &Predicted<'_>| match &leader {
        Some(leader) if judged.is_significant() && *is_exact && (misfit || predicts_better(runs, leader)) => {
            (Place::PredictsBetter, judged.held_out.per_row)
        }
        Some(_) if judged.is_significant() => (Place::Earned, judged.score),
        _ => (Place::None, judged.held_out.per_row),
    };
    candidates.sort_by(|a, b| place(b).0.cmp(&place(a).0).then(place(b).1.total_cmp(&place(a).1)));
    candidates.into_iter().map(|candidate| candidate.judged).collect()
}

/// Where a candidate stands among others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    /// It earns no place.
    None,
    /// It earns one.
    Earned,
    /// It earns one, and predicts unseen runs better than the best by fit does.
    PredictsBetter,
}

/// Whether runs that were not seen are predicted better by more than one standard error over runs.
pub fn predicts_better(runs: &[HeldOutRun], than: &[HeldOutRun]) -> bool {
    HeldOutGain::over(than, runs).exceeds(1.0)
}

/// The base at its best: a candidate that changes nothing may still have found a better place for the others. Where that leaves
/// the range of an effect that was found within it, it is another law's.
fn polished<'a>(bench: &Bench<'a>, base: &Trial<'a>, trials: &[Trial<'a>]) -> Trial<'a> {
    let mut leaders: Vec<_> = trials.iter().collect();
    leaders.sort_by(|a, b| b.log_posterior().total_cmp(&a.log_posterior()));
    let again = leaders.par_iter().take(LEADERS).filter_map(|leader| bench.polish(base, leader));
    let again = again.filter(|polished| base.is_out_of_bounds() || !polished.is_out_of_bounds());
    let best = again.reduce_with(|a, b| if b.log_posterior() > a.log_posterior() { b } else { a });
    best.unwrap_or_else(|| base.clone())
}

/// What a candidate must be worth to be in question.
pub fn enough(trials: &[Trial<'_>], dispersion: f64) -> f64 {
    trials.iter().map(worth).fold(f64::NEG_INFINITY, f64::max) - IN_QUESTION * dispersion
}

/// Whether more than one effect is missing.
pub fn is_misfit<'a, 'b: 'a>(trials: impl Iterator<Item = &'a Trial<'b>>) -> bool {
    trials.map(|trial| trial.fit.dispersion).fold(f64::INFINITY, f64::min) > MISFIT
}

/// Fits of the candidates: after a short look at every one, the best form of each effect, and every form of the effects that
/// look best. Where one looks good and another much less so, the short look at the other is enough.
fn trials<'a>(bench: &Bench<'a>, base: &Trial<'a>, all: &[EffectForm]) -> Vec<Trial<'a>> {
    let held = bench.held(&base.fit);
    let glances: Vec<_> = all.par_iter().filter_map(|form| bench.glance(&held, base, form)).collect();
    let glances = beside_leader(bench, base, glances);
    let best = best_glances(&glances);
    let form = |trial: &Trial<'_>| trial.added().cloned();
    let leaders: Vec<_> = best.iter().take(LEADERS).filter_map(form).collect();
    let leads = |candidate: &EffectForm| leaders.iter().any(|leader| leader.info.id == candidate.info.id);
    let gain = |trial: &Trial<'_>| trial.log_posterior() - base.log_posterior();
    let enough = PROMISING_SHARE * best.first().map_or(0.0, gain) - PROMISING_LESS * base.fit.dispersion.max(1.0);
    let (promising, others): (Vec<_>, Vec<_>) = best.into_iter().skip(LEADERS).partition(|trial| gain(trial) > enough);
    let promising: Vec<_> = promising.iter().filter_map(form).collect();
    let is_chosen = |glance: &&Glance<'a>| {
        form(&glance.better)
            .is_some_and(|form| leads(&form) || promising.iter().any(|other| other.name() == form.name()))
    };
    let mut fitted: Vec<_> = glances.par_iter().filter(is_chosen).filter_map(|glance| bench.pursued(glance)).collect();
    fitted.extend(others);
    let fitted = finished(bench, fitted);
    let again = from_many_starts(bench, base, all, &fitted);
    if again.is_empty() {
        return fitted;
    }
    let mut better = best_of_each(fitted.into_iter().chain(again), form_name);
    better.sort_by(|a, b| worth(b).total_cmp(&worth(a)));
    better
}

/// The best effect in all of its forms from many starts, where it leaves more than noise: its fits may have come to the wrong place, whose
/// misfit the offsets of runs take up.
fn from_many_starts<'a>(
    bench: &Bench<'a>,
    base: &Trial<'a>,
    all: &[EffectForm],
    fitted: &[Trial<'a>],
) -> Vec<Trial<'a>> {
    let best = fitted.iter().max_by(|a, b| worth(a).total_cmp(&worth(b)));
    let Some(best) = best.filter(|best| bench.is_unexplained(&best.fit)) else { return Vec::new() };
    let forms = all.par_iter().filter(|form| form.info.id == best.added_id());
    let again = |form: &EffectForm| bench.fitted_from_many_starts(base.specification.with(form.clone())).ok();
    forms.filter_map(again).collect()
}

/// Of each effect the best short look, the best effect first.
fn best_glances<'a>(glances: &[Glance<'a>]) -> Vec<Trial<'a>> {
    let mut best = best_forms(glances.iter().map(|glance| glance.better.clone()).collect());
    best.sort_by(|a, b| b.log_posterior().total_cmp(&a.log_posterior()));
    best
}

/// Short looks, those at the best forms of the other effects repeated from the soil of the best effect: where that explains more
/// than chance, its soil is nearer to the true one than a soil without any.
fn beside_leader<'a>(bench: &Bench<'a>, base: &Trial<'a>, glances: Vec<Glance<'a>>) -> Vec<Glance<'a>> {
    let best = best_glances(&glances);
    let Some((leader, others)) = best.split_first() else { return glances };
    if leader.log_posterior() - base.log_posterior() < PROMISING_LESS * base.fit.dispersion.max(1.0) {
        return glances;
    }
    let is_other = |glance: &Glance<'a>| others.iter().any(|other| form_name(other) == form_name(&glance.better));
    let again = |glance| if is_other(&glance) { bench.glance_beside(glance, base, leader) } else { glance };
    glances.into_par_iter().map(again).collect()
}

/// The same, those that may win fitted to the end: of runs that it has not seen only a fit at its optimum says anything.
fn finished<'a>(bench: &Bench<'a>, mut fitted: Vec<Trial<'a>>) -> Vec<Trial<'a>> {
    fitted.sort_by(|a, b| worth(b).total_cmp(&worth(a)));
    let rest = fitted.split_off(FINISHED.min(fitted.len()));
    let mut fitted: Vec<_> = fitted.into_par_iter().map(|trial| bench.finished(trial)).collect();
    fitted.extend(rest);
    fitted
}

/// What candidates on top of the same model are compared by: ln posterior, less the cost of what the last effect frees.
pub fn worth(trial: &Trial<'_>) -> f64 {
    trial.log_posterior() - PARAMETER_COST * trial.added_parameters() as f64
}

/// Of each effect the form that is worth most.
fn best_forms(trials: Vec<Trial<'_>>) -> Vec<Trial<'_>> {
    best_of_each(trials, |trial| trial.added_id())
}

fn form_name(trial: &Trial<'_>) -> Option<(&'static str, &'static str)> {
    trial.added().map(EffectForm::name)
}

/// Of those that are the same by a key the one that is worth most, where the first of them was.
fn best_of_each<'a, K: PartialEq>(
    trials: impl IntoIterator<Item = Trial<'a>>,
    key: impl Fn(&Trial<'a>) -> K,
) -> Vec<Trial<'a>> {
    let mut best: Vec<Trial<'a>> = Vec::new();
    for trial in trials {
        match best.iter_mut().find(|other| key(other) == key(&trial)) {
            Some(other) if worth(other) < worth(&trial) => *other = trial,
            Some(_) => {}
            None => best.push(trial),
        }
    }
    best
}

/// The best models with two more effects, of those that go on from the best with one.
pub fn look_ahead<'a>(bench: &Bench<'a>, trials: &[Trial<'a>]) -> Vec<Trial<'a>> {
    let mut leaders = best_forms(trials.to_vec());
    leaders.sort_by(|a, b| worth(b).total_cmp(&worth(a)));
    let seconds = |first: &Trial<'a>| {
        let held = bench.held(&first.fit);
        let next = candidates(bench.campaign, bench.measurements, &first.specification);
        let glance = |form: &EffectForm| bench.glance_near(&held, first, form);
        let mut glances = best_forms(next.par_iter().filter_map(glance).collect());
        glances.sort_by(|a, b| worth(b).total_cmp(&worth(a)));
        let chosen = glances.iter().take(SECONDS).filter_map(Trial::added);
        let chosen: Vec<_> = chosen.collect();
        chosen.into_par_iter().filter_map(|form| bench.with_effect_near(first, form)).collect::<Vec<_>>()
    };
    let mut both: Vec<_> = leaders.par_iter().take(LEADERS).flat_map_iter(seconds).collect();
    both.sort_by(|a, b| worth_of_all(b).total_cmp(&worth_of_all(a)));
    both
}

/// What models with any effects are compared by: ln posterior, less the cost of what all their effects free.
pub fn worth_of_all(trial: &Trial<'_>) -> f64 {
    trial.log_posterior() - PARAMETER_COST * trial.effect_parameters() as f64
}

/// The dispersion that gains are measured in, 1 or more: that of the best model with one more effect, or with two where that
/// was looked for.
pub fn dispersion<'a>(base: &Trial<'a>, trials: &[Trial<'a>], ahead: &[Trial<'a>]) -> f64 {
    let all = std::iter::once(base).chain(trials).chain(ahead);
    all.map(|trial| trial.fit.dispersion).fold(f64::INFINITY, f64::min).max(1.0)
}
