//! A campaign, diagnosed.

use super::assemble::assemble;
use super::bench::Bench;
use super::candidates::is_measured;
use super::curvature::{add_curvature, curvature};
use super::declared_effects::declared_effects;
use super::document::{Diagnosis, Verdict};
use super::force_channels::force_channels;
use super::formula_search::law;
use super::forward::{Selected, select};
use super::held_out_errors::{HeldOutErrors, held_out_errors};
use super::levels::levels_left_out;
use super::lone_rows::{LoneRow, in_words, lone_rows};
use super::measurements::Measurements;
use super::other_forms::in_other_forms;
use super::residual_search::Structure;
use super::specification::Specification;
use super::stated_soil::in_place_of_effects;
use super::trial::Trial;
use crate::data::campaign::{Campaign, Fingerprint};
use crate::error::HostError;

/// Chance below which a candidate is tried again without the held-out runs.
const NEAR: f64 = 0.5;
/// Candidates that are tried again at least.
const AGAIN: usize = 4;

/// Said of a campaign of one run.
const ONE_RUN: &str = "One run only: its rows were held out one by one. What the rows of a run share, such as the state of \
                       the sensors or of the soil on that day, cannot be told from an effect here.";

/// How a campaign is diagnosed.
#[derive(Debug, Clone, Copy, Default)]
pub struct DiagnoseOptions {
    /// Use the rows of braking wheels as well.
    pub braking: bool,
}

/// What came of a diagnosis.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The document.
    pub document: Diagnosis,
    /// The rows that were used.
    pub measurements: Measurements,
    /// Their held-out errors.
    pub errors: HeldOutErrors,
    /// The column that the declared model's residuals follow most.
    pub guilty: Option<String>,
}

/// Diagnoses a campaign. `progress` is told what is being done.
///
/// A declared effect whose form is open is taken in the one that fits best, which may be one that does what is missing. Where that leaves
/// something without an effect, and another form leaves nothing, it is that.
///
/// # Errors
/// Where the campaign lacks what a diagnosis needs, or its declared model fits nothing.
pub fn diagnose(
    campaign: &Campaign,
    options: &DiagnoseOptions,
    progress: &(dyn Fn(&str) + Sync),
) -> Result<Outcome, HostError> {
    let outcome = in_the_best_form(campaign, options, progress)?;
    if outcome.document.verdict != Verdict::Unexplained {
        return Ok(outcome);
    }
    for (other, said) in in_other_forms(campaign, &outcome) {
        progress("another form of what is declared");
        // One that fits nothing is not that.
        let Ok(mut again) = in_the_best_form(&other, options, progress) else { continue };
        if again.document.unexplained.is_empty() {
            again.document.caveats.push(said);
            return Ok(again);
        }
    }
    Ok(outcome)
}

/// The same with each declared effect in the form that fits best before anything is added.
fn in_the_best_form(
    campaign: &Campaign,
    options: &DiagnoseOptions,
    progress: &(dyn Fn(&str) + Sync),
) -> Result<Outcome, HostError> {
    // Of the runs that can be used: another may only brake.
    let single = Measurements::without(campaign, options.braking, &[])?.runs.len() == 1;
    let apart = single.then(|| campaign.clone().with_a_run_for_each_row());
    let in_runs = apart.as_ref().unwrap_or(campaign);
    let whole = Whole { as_given: campaign, in_runs, is_single: single, options, progress };
    progress("declared model");
    let measurements = measured(in_runs, options, &[])?;
    let all = Bench::new(in_runs, &measurements);
    let declared = declared_model(&all)?;
    let lone = lone_rows(&measurements, &declared.fit);
    let without = if lone.is_empty() { None } else { whole.without(&lone, &all, &declared) };
    Ok(without.unwrap_or_else(|| whole.concluded_by_many(&all, &select(&all, declared, progress), &[])))
}

fn ids(selected: &Selected<'_>) -> Vec<&'static str> {
    selected.found.iter().map(|found| found.winner.id()).collect()
}

/// A campaign as it was given, and as its rows are grouped: those of a single run are runs of their own.
struct Whole<'a> {
    as_given: &'a Campaign,
    in_runs: &'a Campaign,
    is_single: bool,
    options: &'a DiagnoseOptions,
    progress: &'a (dyn Fn(&str) + Sync),
}

impl Whole<'_> {
    /// What comes of a selection without rows that the declared model leaves far out; or of one with `all`, where what is found without
    /// these rows explains them, too. None where no model has a fit without them.
    fn without(&self, lone: &[LoneRow], all: &Bench<'_>, declared: &Trial<'_>) -> Option<Outcome> {
        (self.progress)("without rows that stand alone");
        self.selected_without(lone, |bench, selected| {
            let with_all = self.explaining_all(all, declared, selected);
            with_all.unwrap_or_else(|| self.concluded_by_many(bench, selected, lone))
        })
    }

    /// What is made of a selection without some rows; none where no model has a fit without them.
    fn selected_without<R>(&self, lone: &[LoneRow], of: impl FnOnce(&Bench<'_>, &Selected<'_>) -> R) -> Option<R> {
        let fewer = measured(self.in_runs, self.options, lone).ok()?;
        let bench = Bench::new(self.in_runs, &fewer);
        Some(of(&bench, &select(&bench, declared_model(&bench).ok()?, self.progress)))
    }

    /// What comes of a selection with all rows, where it finds what was found without some, and these are no farther out then.
    fn explaining_all(&self, all: &Bench<'_>, declared: &Trial<'_>, without: &Selected<'_>) -> Option<Outcome> {
        let leaves_none = |trial: &Trial<'_>| lone_rows(all.measurements, &trial.fit).is_empty();
        if without.found.is_empty() || !leaves_none(&all.fitted_like(without.model())?) {
            return None;
        }
        (self.progress)("with rows that are explained");
        let selected = select(all, declared.clone(), self.progress);
        let are_same = ids(&selected) == ids(without) && leaves_none(selected.model());
        are_same.then(|| self.concluded(all, &selected, &[]))
    }

    /// What came of a selection, or of another without the rows that its model leaves far out: these may alone bear what was found. Where
    /// some were set aside and nothing was found, nothing is borne by others.
    fn concluded_by_many(&self, bench: &Bench<'_>, selected: &Selected<'_>, set_aside: &[LoneRow]) -> Outcome {
        let is_settled = selected.found.is_empty() && !set_aside.is_empty();
        let further = if is_settled { Vec::new() } else { lone_rows(bench.measurements, &selected.model().fit) };
        let without_these = || {
            let lone = [set_aside, &further].concat();
            self.selected_without(&lone, |bench, again| self.concluded(bench, again, &lone))
        };
        let by_many = if further.is_empty() { None } else { without_these() };
        by_many.unwrap_or_else(|| self.concluded(bench, selected, set_aside))
    }

    /// What came of a selection.
    fn concluded(&self, bench: &Bench<'_>, selected: &Selected<'_>, set_aside: &[LoneRow]) -> Outcome {
        // Rows of one run may share what the force channels would take for an effect: these judge by runs as they are.
        let by_themselves = force_channels(self.as_given, set_aside);
        let measurements = bench.measurements;
        let errors = held_out_errors(bench, &selected.base, &shortlists(selected), self.progress);
        let levels = levels_left_out(measurements, selected);
        let mut document = assemble(self.in_runs, measurements, selected, &errors, levels, &by_themselves);
        document.data = Some(Fingerprint::of(self.as_given));
        if let Some(structure) = selected.left.first() {
            (self.progress)("a law of no list");
            let dispersion = selected.last.as_ref().map_or(selected.dispersion(), |step| step.dispersion);
            document.found_law = law(bench, selected.model(), structure, dispersion);
        }
        let (declared, not_shown) = declared_effects(bench, selected);
        document.declared_effects = declared;
        document.caveats.extend(not_shown);
        document.caveats.extend(in_place_of_effects(bench, selected));
        document.caveats.splice(0..0, in_words(self.as_given, set_aside));
        if self.is_single {
            document.caveats.insert(0, ONE_RUN.to_owned());
        }
        Outcome {
            document,
            measurements: measurements.clone(),
            errors,
            guilty: selected.guilty.as_ref().map(Structure::regressor),
        }
    }
}

/// The rows of a campaign, less some that stand alone; what the bend of the declared model adds counts as noise.
pub(super) fn measured(
    campaign: &Campaign,
    options: &DiagnoseOptions,
    lone: &[LoneRow],
) -> Result<Measurements, HostError> {
    let mut measurements = Measurements::without(campaign, options.braking, lone)?;
    let bends = curvature(&declared_model(&Bench::new(campaign, &measurements))?, &measurements);
    add_curvature(&mut measurements, &bends);
    Ok(measurements)
}

/// The declared model at its best: where the campaign leaves open which form a declared effect has, the form that fits best.
pub(super) fn declared_model<'a>(bench: &Bench<'a>) -> Result<Trial<'a>, HostError> {
    let specifications =
        Specification::declared(bench.campaign, |form| is_measured(bench.campaign, bench.measurements, form))
            .map_err(|count| too_many(bench.campaign, count))?;
    let mut best: Option<Trial<'a>> = None;
    let mut refused = None;
    for specification in specifications {
        match bench.fitted_from_many_starts(specification) {
            Ok(trial) if best.as_ref().is_none_or(|best| trial.log_posterior() > best.log_posterior()) => {
                best = Some(trial)
            }
            Ok(_) => {}
            Err(error) => refused = Some(error),
        }
    }
    best.ok_or_else(|| {
        let why = refused.map_or_else(String::new, |error| format!(": {error}"));
        bench
            .campaign
            .error(format!("the declared model does not fit{why}: expected loads that a soil within [soil] carries"))
    })
}

/// What is said where the declared effects have too many forms together.
fn too_many(campaign: &Campaign, count: usize) -> HostError {
    let most = campaign.declared.effects.iter().filter(|effect| effect.form.is_none());
    let most = most.max_by_key(|effect| effect.info.forms.len()).map(|effect| effect.info);
    let (id, form) = most.map_or(("", ""), |info| (info.id, info.forms.first().map_or("", |form| form.name)));
    HostError::Failed(format!(
        "{}: the effects of [declared] may come in {count} combinations of forms: expected fewer effects, or the form of \
         some, as in [declared.{id}] form = \"{form}\"",
        campaign.path.with_extension("toml").display()
    ))
}

/// For each effect that was found, the candidates that are tried again where runs are held out: what was found before it is
/// one of them, as without those runs another may have come first.
fn shortlists<'a>(selected: &Selected<'a>) -> Vec<Vec<Trial<'a>>> {
    let of_step = |found: &super::forward::FoundStep<'a>| {
        // What won only beside a second effect would not be chosen before that one.
        let alone = found.step.ranking.iter().find(|judged| judged.is_significant());
        if alone.is_none_or(|alone| alone.id() != found.winner.id()) {
            return vec![found.winner.trial.clone()];
        }
        let near = found.step.ranking.iter().enumerate();
        let near = near.filter(|(place, judged)| *place < AGAIN || judged.p_value < NEAR);
        near.map(|(_, judged)| judged.trial.clone()).collect()
    };
    let found_before = |step: usize| selected.found[..step].iter().map(|found| found.winner.trial.clone());
    let with_those = |(step, found)| of_step(found).into_iter().chain(found_before(step)).collect();
    selected.found.iter().enumerate().map(with_those).collect()
}
