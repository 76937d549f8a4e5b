//! Whether an effect only mimics a dependence that no physics stands behind.

use super::bench::Bench;
use super::fit::Reading;
use super::linearised::{AddedTerms, Linearised};
use super::measurements::COLUMNS;
use super::residual_search::Structure;
use super::selection::{PARAMETER_COST, Step, TELLS_APART};
use super::specification::EffectForm;
use super::trial::Trial;
use crate::data::campaign::Channel;

/// What the dependence must still gain in ln likelihood beside the effect to be more than the effect is.
const MORE: f64 = 6.0;
/// What the effect must still gain beside the dependence to be more than its mimic.
const OWN: f64 = 6.0;
/// Effects that are the dependence of a channel on a column, whatever its law: on nothing else of the list could it depend so.
const NAMED_FOR: [(&str, Reading, Channel); 3] = [
    ("rate", Reading::Sinkage, Channel::Speed),
    ("multi-pass", Reading::Sinkage, Channel::Pass),
    ("lateral-slip", Reading::SideForce, Channel::SlipAngle),
];

/// Times that a model is linearised, each time about where it came to.
const ROUNDS: usize = 3;

/// Each is added to the model beside the other. An effect that then gains nothing of its own, while the dependence still
/// gains much, or by itself gains more than the effect by what tells two candidates apart, only mimics it. An effect that is
/// real carries over to every channel, and its mimics gain nothing beside it. What the dependence has in common with any
/// other of the contact, an offset of the channel and a trend with slip, load or sinkage, is not counted for it: where a second
/// effect is missing that gains much, whatever the column is.
pub fn is_mimic(bench: &Bench<'_>, step: &Step<'_>, effect: &Trial<'_>, structure: &Structure) -> bool {
    let (added, common) = (&structure.added, &structure.common);
    let gains = || {
        let form = effect.added()?;
        let dependence = log_posterior_with(bench, &step.base, added)?;
        let both = log_posterior_with(bench, effect, added)?;
        let alone = log_posterior_with(bench, effect, common)?;
        let beside =
            |less: f64, parameters: usize| (both - less) / step.dispersion - PARAMETER_COST * parameters as f64;
        let own_terms = added.terms.len() - common.terms.len();
        let gained = beside(dependence, effect.added_parameters());
        // An effect that is itself such an offset or trend is part of every dependence, and one that follows a column of every
        // product with it: none is better for having it.
        let is_part = structure.columns.iter().any(|column| follows(form, structure.channel, column));
        let is_common = is_part
            || gained < OWN && {
                let without = log_posterior_with(bench, &step.base, common)?;
                (alone - without) / step.dispersion < OWN
            };
        Some((beside(alone, own_terms), gained, is_common))
    };
    // The difference of the two gains is that of the dependence alone and the effect alone.
    let is_better = |dependence: f64, effect: f64, is_common: bool| {
        dependence > MORE || (!is_common && dependence - effect > TELLS_APART)
    };
    gains().is_some_and(|(dependence, effect, is_common)| effect < OWN && is_better(dependence, effect, is_common))
}

/// Whether a dependence is of the channel that an effect's form acts on, on the column that it follows there, or is what the
/// effect is named for: then it is the effect by another law, and no other cause. An angle of the wheel is a column of many laws.
pub fn is_own_law(effect: &EffectForm, structure: &Structure) -> bool {
    let Structure { channel, columns, .. } = structure;
    let is_followed = matches!(columns.as_slice(), [column] if follows(effect, *channel, column));
    is_followed || is_named_for(effect, *channel, columns)
}

/// Whether an effect is named for what a channel does with a column, or with a product of which that is one.
fn is_named_for(effect: &EffectForm, channel: Reading, columns: &[String]) -> bool {
    let named = NAMED_FOR.iter().find(|(id, of, _)| *id == effect.info.id && *of == channel);
    named.is_some_and(|(.., by)| columns.iter().any(|column| column == by.name()))
}

/// Whether a form acts on a channel and follows a column there.
fn follows(effect: &EffectForm, channel: Reading, column: &str) -> bool {
    let needs = |channel: Channel| effect.form.needs.iter().any(|column| Channel::read_from(*column) == Some(channel));
    let column = Channel::from_name(column);
    needs(COLUMNS[channel.index()]) && column.is_some_and(needs) && column != Some(Channel::WheelAngle)
}

/// ln posterior of a model with added terms. A model that lacks much is bent far by making up for it: linearised once, it would
/// not come back all the way when the terms take over.
fn log_posterior_with(bench: &Bench<'_>, trial: &Trial<'_>, added: &AddedTerms) -> Option<f64> {
    let measurements = bench.measurements;
    let mut here = trial.fit.clone();
    let mut found = None;
    for _ in 0..ROUNDS {
        let rows = &measurements.rows;
        let about = Linearised::about(&trial.model, &here, rows, measurements, &bench.options);
        let Some(about) = about else { break };
        let fit = about.fit_with(added).ok()?;
        found = Some(fit.log_likelihood + trial.log_prior(&fit.parameters));
        let own = here.parameters.len();
        here.parameters.clone_from_slice(fit.parameters.get(..own)?);
        here.latents = fit.latents;
    }
    found
}

#[cfg(test)]
mod tests {
    use kapvik_firmware::terramechanics::effects::effect_info;

    use super::*;

    #[test]
    fn a_rate_is_whatever_sinkage_does_with_speed() {
        let info = effect_info("rate").expect("listed");
        let rate = EffectForm::new(info, &info.forms[0]);
        let is_named_for = |channel, columns: &[&str]| {
            let columns: Vec<String> = columns.iter().map(|column| (*column).to_owned()).collect();
            is_named_for(&rate, channel, &columns)
        };
        assert!(is_named_for(Reading::Sinkage, &["speed_m_s"]));
        assert!(is_named_for(Reading::Sinkage, &["slip", "speed_m_s"]));
        assert!(!is_named_for(Reading::DrawbarPull, &["speed_m_s"]));
        assert!(!is_named_for(Reading::Sinkage, &["temperature_c"]));
    }

    #[test]
    fn a_drift_with_temperature_follows_no_other_column_and_in_its_channel_alone() {
        let info = effect_info("force-drift").expect("listed");
        let form = info.forms.iter().find(|form| form.name == "side force with temperature").expect("a form");
        let drift = EffectForm::new(info, form);
        assert!(follows(&drift, Reading::SideForce, "temperature_c"));
        assert!(!follows(&drift, Reading::SideForce, "hours_since_zero"));
        assert!(!follows(&drift, Reading::DrawbarPull, "temperature_c"));
    }
}
