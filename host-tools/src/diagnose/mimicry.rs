//! Whether an effect only mimics a dependence that no physics stands behind.

use super::fit::Fit;
use super::linearised::{AddedTerms, Linearised};
use super::residual_search::{Structure, terms_of};
use super::selection::{PARAMETER_COST, Step};
use super::trial::{Bench, Trial};

/// What the dependence must still gain in ln likelihood beside the effect to be more than the effect is.
const MORE: f64 = 6.0;
/// What the effect must still gain beside the dependence to be more than its mimic.
const OWN: f64 = 6.0;

/// Each is added to the model beside the other. An effect that then gains nothing of its own, while the dependence still
/// gains much, only mimics it. An effect that is real carries over to every channel, and its mimics gain nothing beside it.
pub fn is_mimic(bench: &Bench<'_>, step: &Step<'_>, effect: &Trial<'_>, structure: &Structure) -> bool {
    let Some(added) = terms_of(bench, structure) else { return false };
    let nothing = AddedTerms { channel: structure.channel, terms: Vec::new() };
    let fitted = |trial: &Trial<'_>, added: &AddedTerms| {
        let measurements = bench.measurements;
        let rows = &measurements.rows;
        let about = Linearised::about(&trial.model, &trial.fit, rows, &measurements.rows_of_run, &bench.options)?;
        let found = about.fit_with(added).ok()?;
        Some(log_posterior(trial, &found))
    };
    let gains = || {
        let dependence = fitted(&step.base, &added)?;
        let both = fitted(effect, &added)?;
        let alone = fitted(effect, &nothing)?;
        let beside_effect = (both - alone) / step.dispersion - PARAMETER_COST * added.terms.len() as f64;
        let beside_dependence =
            (both - dependence) / step.dispersion - PARAMETER_COST * effect.added_parameters() as f64;
        Some((beside_effect, beside_dependence))
    };
    gains().is_some_and(|(dependence, effect)| dependence > MORE && effect < OWN)
}

fn log_posterior(trial: &Trial<'_>, found: &Fit) -> f64 {
    found.log_likelihood + trial.log_prior(&found.parameters)
}
