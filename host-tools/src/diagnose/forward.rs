//! Forward selection: one effect after the other, while each earns its place.

use super::bench::Bench;
use super::candidates::candidates;
use super::mimicry::{is_mimic, is_own_law};
use super::pairs::{Known, Pair, alone, from_ahead, from_known};
use super::residual_search::{Structure, search};
use super::selection::{Judged, Step, look_ahead};
use super::sensor_rival::{Rival, alone_on, rival};
use super::steps::Steps;
use super::trial::Trial;

/// Most effects that are looked for.
const MOST_EFFECTS: usize = 4;
/// Most other effects that one is stated to be ambiguous with.
const MOST_ALTERNATIVES: usize = 2;
/// Bare dependences that an effect is held against.
const SUSPECTS: usize = 3;

/// What the selection came to.
#[derive(Debug, Clone)]
pub struct Selected<'a> {
    /// The declared model.
    pub base: Trial<'a>,
    /// The effects that earned their place, each with the step that found it.
    pub found: Vec<FoundStep<'a>>,
    /// The step at which the search ended.
    pub last: Option<Step<'a>>,
    /// Structure that is left.
    pub left: Vec<Structure>,
    /// The column that the declared model's residuals follow most, beyond chance or not.
    pub guilty: Option<Structure>,
    /// A law of a sensor that took the place of effects, or is not told from those that were found.
    pub rival: Option<Rival<'a>>,
}

/// An effect that earned its place, and the field that it won in.
#[derive(Debug, Clone)]
pub struct FoundStep<'a> {
    /// The winner.
    pub winner: Judged<'a>,
    /// The ids that these data do not tell from it, the likeliest.
    pub ambiguous_with: Vec<&'static str>,
    /// The same of those for which there was no place among these.
    pub also_near: Vec<&'static str>,
    /// Everyone.
    pub step: Step<'a>,
}

impl FoundStep<'_> {
    /// All the ids that these data do not tell from it, the likeliest first.
    pub fn not_told_from(&self) -> Vec<&'static str> {
        [self.ambiguous_with.as_slice(), &self.also_near].concat()
    }
}

impl<'a> Selected<'a> {
    /// The model with all the effects that were found.
    pub fn model(&self) -> &Trial<'a> {
        self.found.last().map_or(&self.base, |found| &found.winner.trial)
    }

    /// The dispersion of that model, 1 or more.
    pub fn dispersion(&self) -> f64 {
        self.model().fit.dispersion.max(1.0)
    }
}

/// Adds effects to a model while they earn their place.
pub fn select<'a>(bench: &Bench<'a>, base: Trial<'a>, progress: &(dyn Fn(&str) + Sync)) -> Selected<'a> {
    let mut selected = Selected { base, found: Vec::new(), last: None, left: Vec::new(), guilty: None, rival: None };
    let mut known: Option<Left> = None;
    let steps = Steps::new(bench);
    while selected.found.len() < MOST_EFFECTS {
        progress(&format!("effect {}", selected.found.len() + 1));
        let here = steps.on(selected.model());
        selected.left = left(bench, selected.model(), here.dispersion, known.take());
        match selected.found.last_mut() {
            Some(last) => last.winner.trial = here.base.clone(),
            None => selected.base = here.base.clone(),
        }
        if selected.found.is_empty() {
            selected.guilty = selected.left.first().cloned();
        }
        let won = winner(bench, &here, &selected.left);
        let place = won.as_ref().map(|(place, _)| *place);
        if let Some(instead) = instead_of_both(&steps, &selected, &here, place) {
            selected.found = vec![instead];
            continue;
        }
        let is_beyond_chance = |both: &Pair<'_>| {
            let tried = candidates(bench.campaign, bench.measurements, &selected.base.specification).len();
            both.is_beyond_chance(&selected.base, tried)
        };
        if let Some(both) = together(&steps, &selected, &here, place).filter(is_beyond_chance) {
            // What was tried without any effect is what the first was found among, whichever it became.
            let step = selected.found.pop().map_or(here, |found| found.step);
            let [first, second] = both.in_order_of(&step);
            selected.found.extend([FoundStep { step, ..first }, second]);
            continue;
        }
        match won {
            Some((place, structures)) => {
                known = Some(Left { dispersion: here.dispersion, structures });
                selected.found.push(found(here, place));
            }
            None => {
                selected.last = Some(here);
                break;
            }
        }
    }
    if selected.last.is_none() {
        selected.left = left(bench, selected.model(), selected.dispersion(), known);
    }
    selected.left.retain(Structure::is_significant);
    held_against_sensors(bench, &mut selected);
    selected
}

/// Takes off the effects in whose place a law of a sensor that stands in no list explains the data better; where nothing was found and no
/// column accused, looks for such a law all the same.
fn held_against_sensors<'a>(bench: &Bench<'a>, selected: &mut Selected<'a>) {
    if selected.found.is_empty() {
        let is_open = selected.left.is_empty();
        selected.rival = if is_open { alone_on(bench, &selected.base, selected.dispersion()) } else { None };
        return;
    }
    let Some(found) = rival(bench, selected) else { return };
    if found.takes_place {
        let displaced = selected.found.drain(found.stay..);
        selected.last = displaced.into_iter().next().map(|displaced| displaced.step);
        selected.left.clear();
    }
    selected.rival = Some(found);
}

/// What the last winner leaves, and the dispersion by which that was judged.
struct Left {
    dispersion: f64,
    structures: Vec<Structure>,
}

/// What a model leaves: as it was seen when the model won, if that was judged by the same dispersion.
fn left(bench: &Bench<'_>, model: &Trial<'_>, dispersion: f64, known: Option<Left>) -> Vec<Structure> {
    let same = known.filter(|known| known.dispersion == dispersion);
    same.map_or_else(|| search(bench, model, dispersion), |known| known.structures)
}

/// The second effect in place of both, where it explains more by itself than the first does.
fn instead_of_both<'a>(
    steps: &Steps<'_, 'a>,
    selected: &Selected<'a>,
    here: &Step<'a>,
    place: Option<usize>,
) -> Option<FoundStep<'a>> {
    let [first] = selected.found.as_slice() else { return None };
    alone(steps, &first.step, &here.base, &here.ranking[place?].trial)
}

/// Two effects in place of the first, or of none: where a second was found, and where none of the effects alone leads on although
/// the data ask for more.
fn together<'a>(
    steps: &Steps<'_, 'a>,
    selected: &Selected<'a>,
    here: &Step<'a>,
    place: Option<usize>,
) -> Option<Pair<'a>> {
    let (first, known) = match selected.found.as_slice() {
        [] if place.is_none() => (here, None),
        [found_first] => {
            let companion = place.map(|place| found(here.clone(), place));
            (&found_first.step, Some(Known { one: here.base.clone(), companion }))
        }
        _ => return None,
    };
    let tried = known.as_ref().map_or("", |known| known.one.added_id());
    let best = known.and_then(|known| from_known(steps, known));
    let asks_for_more = || {
        let is_of_contact = |structure: &Structure| structure.is_significant() && structure.of_contact;
        here.ranking.iter().any(Judged::is_beyond_chance) || selected.left.iter().any(is_of_contact)
    };
    if best.is_some() && first.ahead.is_empty() || !asks_for_more() {
        return best;
    }
    if !first.ahead.is_empty() {
        return from_ahead(steps, first, &first.ahead, tried, best);
    }
    let trials: Vec<_> = first.ranking.iter().map(|judged| judged.trial.clone()).collect();
    from_ahead(steps, first, &look_ahead(steps.bench, &trials), tried, None)
}

/// The best candidate that chance does not explain, and what it leaves; none where a bare dependence on a column explains what
/// it does and more: one of those that the model without it shows, or of those that it leaves.
pub fn winner(bench: &Bench<'_>, step: &Step<'_>, structures: &[Structure]) -> Option<(usize, Vec<Structure>)> {
    let place = step.ranking.iter().position(Judged::is_significant)?;
    let (effect, form) = (&step.ranking[place].trial, step.ranking[place].effect()?);
    // Every effect is a function of the contact, so that a curve in slip, load or sinkage accuses none.
    let is_other = |structure: &Structure| !structure.of_contact && !is_own_law(form, structure);
    let is_suspect = |structure: &&Structure| structure.is_significant() && is_other(structure);
    let is_mimic_of_one = |structures: &[Structure]| {
        structures.iter().filter(is_suspect).take(SUSPECTS).any(|structure| is_mimic(bench, step, effect, structure))
    };
    if is_mimic_of_one(structures) {
        return None;
    }
    let left = search(bench, effect, step.dispersion);
    (!is_mimic_of_one(&left)).then_some((place, left))
}

/// The candidate at a place of a step's ranking, as an effect that was found.
pub fn found(step: Step<'_>, place: usize) -> FoundStep<'_> {
    let winner = step.ranking[place].clone();
    let is_another = |other: &Judged<'_>| other.id() != winner.id() && !other.trial.has_no_reference();
    let near = |other: &&Judged<'_>| is_another(other) && winner.is_near(other);
    let mut ambiguous_with: Vec<_> = step.ranking.iter().filter(near).map(Judged::id).collect();
    let also_near = ambiguous_with.split_off(MOST_ALTERNATIVES.min(ambiguous_with.len()));
    FoundStep { winner, ambiguous_with, also_near, step }
}
