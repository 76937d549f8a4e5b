//! Other forms of what a campaign declares: the one that fits best may be one that does what is missing.

use super::candidates::is_measured;
use super::outcome::Outcome;
use crate::data::campaign::Campaign;

/// A campaign with one of its declared effects in another form that it may have, and what is said where that is the one.
pub fn in_other_forms(campaign: &Campaign, outcome: &Outcome) -> Vec<(Campaign, String)> {
    let fitted = &outcome.document.declared_effects;
    let other = |place: usize| {
        let effect = &campaign.declared.effects[place];
        let measured = effect.open_forms().filter(|form| is_measured(campaign, &outcome.measurements, form));
        let name = fitted.get(place).map_or("", |fitted| fitted.form.as_str());
        measured.filter(move |form| form.name != name).map(move |form| {
            let mut other = campaign.clone();
            other.declared.effects[place] = effect.in_form(form);
            let id = effect.info.id;
            let said = format!(
                "The form of {id} is not declared. As {name} it fits best by itself, but leaves what no effect explains; as {}, in this \
                 diagnosis, it does not.",
                form.name
            );
            (other, said)
        })
    };
    (0..campaign.declared.effects.len()).flat_map(other).collect()
}
