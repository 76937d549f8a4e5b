//! The maximum a posteriori, with the effects that are declared.

use kapvik_firmware::identification::Belief;
use kapvik_firmware::identification::map::{DeclaredEffects, Fitted, FreeParameter, MapEstimate, identify_declared};
use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::terramechanics::effects::{Effects, Form};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::data::campaign::{DeclaredEffect, Knowledge};

use super::rebound::{free_rebound, put_back, without_rebound};
use super::{Evidence, Finding, Fit, Statement, method_refusal};

/// χ² by which, beside two for each parameter more, another form of what is declared has to explain the wheels better.
const BETTER: f64 = 6.0;
/// Standard deviations by which a parameter is another.
const ANOTHER: f64 = 2.0;

/// The posterior's mean and intervals.
///
/// # Errors
/// The refusal, in words; where too many parameters of effects are free.
pub fn map(evidence: &Evidence) -> Result<Finding, String> {
    let estimate = in_the_best_forms(evidence)?;
    let mut finding = Finding::from(&estimate.identified);
    finding.cohesion_pa = of_logarithm(finding.cohesion_pa, estimate.ln_cohesion);
    finding.shear_modulus_m = of_logarithm(finding.shear_modulus_m, estimate.ln_shear_modulus);
    finding.fit = Some(fit(&estimate));
    let beliefs = [evidence.prior.ln_cohesion, evidence.prior.friction_angle_rad, evidence.prior.ln_shear_modulus];
    for (statement, belief) in finding.statements_mut().into_iter().zip(beliefs) {
        statement.assumed = belief.is_known();
    }
    for (id, without) in without_what_is_not_shown(evidence, &estimate) {
        doubt(&mut finding, id, &without);
    }
    Ok(finding)
}

/// Estimates without one of the declared effects each that explain the wheels as well as with it.
fn without_what_is_not_shown(
    evidence: &Evidence,
    estimate: &MapEstimate<f64>,
) -> Vec<(&'static str, MapEstimate<f64>)> {
    let without = |left_out: &DeclaredEffect| {
        let others = evidence.declared.iter().filter(|effect| effect.info.id != left_out.info.id);
        let found = in_the_best_forms(&Evidence { declared: others.cloned().collect(), ..evidence.clone() }).ok()?;
        (found.misfit <= estimate.misfit + BETTER).then_some((left_out.info.id, found))
    };
    evidence.declared.iter().filter_map(without).collect()
}

/// Says of parameters that they are not told where they are others without an effect which the data do not show.
fn doubt(finding: &mut Finding, id: &str, without: &MapEstimate<f64>) {
    let other = Finding::from(&without.identified);
    let mut names = Vec::new();
    let statements = finding.statements_mut().into_iter().zip(other.statements()).zip(["c", "φ", "K"]);
    for ((statement, other), name) in statements {
        if statement.identifiable && (statement.value - other.value).abs() > ANOTHER * statement.std {
            statement.identifiable = false;
            names.push(format!("{name} is {:.3e} without it", other.value));
        }
    }
    if !names.is_empty() {
        finding.remarks.push(format!("{id} is declared and not shown by these data: {}", names.join(", ")));
    }
}

/// The soil of the greatest posterior probability; none where the method refuses.
pub fn most_probable_soil(evidence: &Evidence) -> Option<Soil<f64>> {
    in_the_best_forms(evidence).ok().map(|estimate| estimate.mode)
}

/// With the declared effects in the first forms that they may have, or in those that explain the wheels better by more than chance does.
fn in_the_best_forms(evidence: &Evidence) -> Result<MapEstimate<f64>, String> {
    let fitted = |effects: &[DeclaredEffect]| {
        let mut declared = declared(evidence, effects)?;
        let Evidence { wheel, observations, conditions, prior, .. } = evidence;
        let rebound = free_rebound(evidence);
        let prior = if rebound.is_some() { without_rebound(prior) } else { *prior };
        rebound.into_iter().try_for_each(|rebound| fit_along(rebound, &mut declared))?;
        let estimate = identify_declared(wheel, observations, conditions, &prior, &declared);
        let mut estimate = estimate.map_err(method_refusal)?;
        if rebound.is_some() {
            put_back(&mut estimate);
        }
        Ok::<_, String>((estimate, declared.free.len()))
    };
    let cost = |(estimate, free): &(MapEstimate<f64>, usize)| estimate.misfit + 2.0 * *free as f64;
    let first = fitted(&evidence.declared);
    let others = in_other_forms(evidence);
    let best = others.iter().filter_map(|effects| fitted(effects).ok()).min_by(|a, b| cost(a).total_cmp(&cost(b)));
    match (first, best) {
        (Ok(first), Some(best)) if cost(&best) < cost(&first) - BETTER => Ok(best.0),
        (Err(_), Some(best)) => Ok(best.0),
        (first, _) => first.map(|(estimate, _)| estimate),
    }
}

/// The form that is stated, else the first that an effect may have of those whose columns are known.
fn first_form(evidence: &Evidence, effect: &DeclaredEffect) -> Option<&'static Form> {
    effect.form.or_else(|| effect.open_forms().find(|form| evidence.has(form))).or_else(|| effect.first_form())
}

/// The declared effects, one of them in another form that it may have, of those whose columns are known.
fn in_other_forms(evidence: &Evidence) -> Vec<Vec<DeclaredEffect>> {
    let effects = evidence.declared.as_slice();
    let other = |place: usize| {
        let effect = &effects[place];
        let first = first_form(evidence, effect).map(|form| form.name);
        effect.open_forms().filter(move |form| evidence.has(form) && Some(form.name) != first).map(move |form| {
            let mut effects = effects.to_vec();
            effects[place] = effects[place].in_form(form);
            effects
        })
    };
    (0..effects.len()).flat_map(other).collect()
}

/// Intervals of a logarithm are not symmetric about the number.
fn of_logarithm(statement: Statement, logarithm: Fitted<f64>) -> Statement {
    let interval = |width: f64| [-1.0, 1.0].map(|side| (logarithm.mean + side * width * logarithm.std).exp());
    Statement { interval_68: interval(1.0), interval_95: interval(1.96), ..statement }
}

fn fit(estimate: &MapEstimate<f64>) -> Fit {
    let degrees_of_freedom = f64::from(estimate.degrees_of_freedom);
    let p_value = ChiSquared::new(degrees_of_freedom.max(1.0)).map_or(f64::NAN, |chi| chi.sf(estimate.misfit));
    Fit { chi_square: estimate.misfit, degrees_of_freedom, p_value, soil: estimate.soil }
}

fn declared(evidence: &Evidence, effects: &[DeclaredEffect]) -> Result<DeclaredEffects<f64>, String> {
    let mut declared = DeclaredEffects {
        effects: Effects::none(),
        free: heapless::Vec::new(),
        grousers: evidence.grousers,
        gravity_m_s2: evidence.gravity_m_s2,
    };
    for effect in effects {
        declare(effect, first_form(evidence, effect), &mut declared)?;
    }
    Ok(declared)
}

/// Puts in an effect in a form; what this frees and the file does not know is free within its bounds.
fn declare(effect: &DeclaredEffect, form: Option<&Form>, declared: &mut DeclaredEffects<f64>) -> Result<(), String> {
    let info = effect.info;
    declared.effects.add(info.id);
    for parameter in info.parameters {
        let set = form.and_then(|form| form.set.iter().find(|(name, _)| *name == parameter.name));
        if let Some((name, value)) = set {
            declared.effects.set(info.id, name, *value);
        }
        let is_free = form.is_some_and(|form| form.free.contains(&parameter.name));
        let belief = match effect.known.get(parameter.name) {
            Some(Knowledge::Value { value, std }) if *std == 0.0 => {
                declared.effects.set(info.id, parameter.name, *value);
                continue;
            }
            Some(Knowledge::Value { value, std }) => {
                Belief { mean: *value, std: Some(*std), low: parameter.low, high: parameter.high }
            }
            Some(Knowledge::Between { min, max }) => Belief::flat(*min, *max),
            None if is_free => Belief::flat(parameter.low, parameter.high),
            None => continue,
        };
        fit_along(FreeParameter { effect: info.id, parameter: parameter.name, belief }, declared)?;
    }
    Ok(())
}

fn fit_along(parameter: FreeParameter<f64>, declared: &mut DeclaredEffects<f64>) -> Result<(), String> {
    declared.free.push(parameter).map_err(|_| {
        format!("more than {} free parameters of declared effects: give the values of some", declared.free.capacity())
    })
}
