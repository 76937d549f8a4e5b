//! Two effects that are both missing.
//!
//! Forward selection names first what alone makes up for most of both, which need be neither. So once there are two, each is
//! asked for again beside the other (floating selection; Pudil, Novovicova and Kittler 1994, Pattern Recognition Letters
//! 15:1119-1125), until each is the best companion of the other and earns its place beside it.

use super::forward::{FoundStep, found, winner};
use super::gain_chance::Gain;
use super::residual_search::search;
use super::selection::{SIGNIFICANT, Step, with_better_fit, worth, worth_of_all};
use super::specification::EffectForm;
use super::steps::Steps;
use super::trial::Trial;

/// Times that an effect, or its form, may be exchanged.
const EXCHANGES: usize = 4;

/// Two effects in order, each beside the other.
pub struct Pair<'a> {
    /// The first, as found beside the second.
    pub first: FoundStep<'a>,
    /// The second, as found on top of the first.
    pub second: FoundStep<'a>,
    /// What both together are worth.
    worth: f64,
}

impl<'a> Pair<'a> {
    /// Whether chance does not explain what both gain together over the model without either, over all pairs of so many candidates: two that
    /// are of little worth alone may each make up for what the other does wrong.
    pub fn is_beyond_chance(&self, without: &Trial<'_>, tried: usize) -> bool {
        let both = &self.second.winner.trial;
        let parameters = both.effect_parameters() - without.effect_parameters();
        let gain = Gain::over(without, both, self.second.step.dispersion);
        let gain = Gain { rows_per_reading: both.fit.rows_per_reading(), ..gain };
        gain.chance(parameters, tried * tried.saturating_sub(1) / 2) < SIGNIFICANT
    }

    /// The two in the order in which a step without either ranks them: each stands on top of the other, and which of them the
    /// search set out from says nothing.
    pub fn in_order_of(self, step: &Step<'a>) -> [FoundStep<'a>; 2] {
        let place = |found: &FoundStep<'_>| step.ranking.iter().position(|judged| judged.id() == found.winner.id());
        match (place(&self.first), place(&self.second)) {
            (Some(first), Some(second)) if second < first => [self.second, self.first],
            _ => [self.first, self.second],
        }
    }
}

/// An effect that was found first, and what was then found.
pub struct Known<'a> {
    /// The model with the effect.
    pub one: Trial<'a>,
    /// Its companion, if one earned its place.
    pub companion: Option<FoundStep<'a>>,
}

/// The pair that is reached from an effect that was found first.
pub fn from_known<'a>(steps: &Steps<'_, 'a>, known: Known<'a>) -> Option<Pair<'a>> {
    settled(steps, known.one, Some(known.companion?))
}

/// The companion of an effect that was found first, where by itself it explains more than that one: its first fit had not found
/// the way that it found beside the other.
pub fn alone<'a>(steps: &Steps<'_, 'a>, first: &Step<'a>, one: &Trial<'a>, both: &Trial<'a>) -> Option<FoundStep<'a>> {
    let bench = steps.bench;
    let other = bench.finished(bench.without_effect(both, one.added_id())?);
    let id = other.added_id();
    if worth(&other) <= worth(one) {
        return None;
    }
    let again = with_better_fit(bench, first, other);
    let structures = search(bench, &again.base, again.dispersion);
    let (place, _) = winner(bench, &again, &structures)?;
    (again.ranking[place].id() == id).then(|| found(again, place))
}

/// The best pair that is reached from the two effects that go best together of those `ahead` of a first step, or the one that
/// is known already. What was `tried` leads nowhere by itself.
pub fn from_ahead<'a>(
    steps: &Steps<'_, 'a>,
    first: &Step<'a>,
    ahead: &[Trial<'a>],
    tried: &str,
    mut best: Option<Pair<'a>>,
) -> Option<Pair<'a>> {
    let declared = first.base.specification.effects.len();
    for effect in ahead.first().into_iter().flat_map(|both| &both.specification.effects[declared..]) {
        let id = effect.info.id;
        let is_reached = |pair: &Pair<'_>| pair.second.winner.trial.specification.has(id);
        if id == tried || best.as_ref().is_some_and(is_reached) {
            continue;
        }
        let alone = first.ranking.iter().find(|judged| judged.id() == id);
        let next = alone.and_then(|judged| settled(steps, judged.trial.clone(), None));
        if next.as_ref().is_some_and(|next| best.as_ref().is_none_or(|best| next.worth > best.worth)) {
            best = next;
        }
    }
    best
}

/// From a model whose last effect is the first of a pair: its best companion, that one's best companion, and so on until they
/// agree, in form as well: which form of an effect fits best without its companion says little. None where there is no companion, or
/// no agreement.
fn settled<'a>(steps: &Steps<'_, 'a>, start: Trial<'a>, mut known: Option<FoundStep<'a>>) -> Option<Pair<'a>> {
    let mut one = start;
    for left in (0..EXCHANGES).rev() {
        let second = known.take().or_else(|| companion(steps, &one))?;
        let both = &second.winner.trial;
        let other = steps.bench.without_effect(both, one.added_id())?;
        let first = companion(steps, &other)?;
        let id = one.added_id();
        let next = if first.winner.id() == id || first.ambiguous_with.contains(&id) {
            let kept = first.step.ranking.iter().position(|judged| judged.id() == id && judged.is_significant())?;
            let again = &first.step.ranking[kept].trial;
            let [again_in, both_in] = [again, both].map(|trial| trial.specification.effect(id).map(EffectForm::name));
            let worth = worth_of_all(both);
            if left == 0 || again_in == both_in || worth_of_all(again) <= worth {
                return Some(Pair { first: found(first.step, kept), second, worth });
            }
            again
        } else {
            &first.winner.trial
        };
        one = steps.bench.without_effect(next, other.added_id())?;
    }
    None
}

fn companion<'a>(steps: &Steps<'_, 'a>, trial: &Trial<'a>) -> Option<FoundStep<'a>> {
    let here = steps.on(trial);
    let structures = search(steps.bench, &here.base, here.dispersion);
    let (place, _) = winner(steps.bench, &here, &structures)?;
    Some(found(here, place))
}
