//! Whether an effect only mimics a dependence that no physics stands behind.

use super::fit::Fit;
use super::linearised::{AddedTerms, Linearised};
use super::residual_search::Structure;
use super::selection::{PARAMETER_COST, Step, TELLS_APART};
use super::trial::{Bench, Trial};

/// What the dependence must still gain in ln likelihood beside the effect to be more than the effect is.
const MORE: f64 = 6.0;
/// What the effect must still gain beside the dependence to be more than its mimic.
const OWN: f64 = 6.0;

/// Each is added to the model beside the other. An effect that then gains nothing of its own, while the dependence still
/// gains much, or by itself gains more than the effect by what tells two candidates apart, only mimics it. An effect that is
/// real carries over to every channel, and its mimics gain nothing beside it.
pub fn is_mimic(bench: &Bench<'_>, step: &Step<'_>, effect: &Trial<'_>, structure: &Structure) -> bool {
    let added = &structure.added;
    let gains = || {
        let (without, with) = (about(bench, &step.base)?, about(bench, effect)?);
        let dependence = log_posterior(&step.base, &without.fit_with(added).ok()?);
        let both = log_posterior(effect, &with.fit_with(added).ok()?);
        let nothing = AddedTerms { terms: Vec::new(), ..*added };
        let alone = log_posterior(effect, &with.fit_with(&nothing).ok()?);
        let beside =
            |less: f64, parameters: usize| (both - less) / step.dispersion - PARAMETER_COST * parameters as f64;
        Some((beside(alone, added.terms.len()), beside(dependence, effect.added_parameters())))
    };
    // The difference of the two is that of the dependence alone and the effect alone.
    let is_better = |dependence: f64, effect: f64| dependence > MORE || dependence - effect > TELLS_APART;
    gains().is_some_and(|(dependence, effect)| effect < OWN && is_better(dependence, effect))
}

fn about<'a>(bench: &'a Bench<'_>, trial: &Trial<'_>) -> Option<Linearised<'a>> {
    let measurements = bench.measurements;
    Linearised::about(&trial.model, &trial.fit, &measurements.rows, &measurements.rows_of_run, &bench.options)
}

fn log_posterior(trial: &Trial<'_>, found: &Fit) -> f64 {
    found.log_likelihood + trial.log_prior(&found.parameters)
}
