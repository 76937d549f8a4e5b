//! The maximum a posteriori, with the effects that are declared.

use kapvik_firmware::identification::map::{DeclaredEffects, Fitted, FreeParameter, MapEstimate, identify_declared};
use kapvik_firmware::identification::{Belief, SoilPrior};
use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::terramechanics::effects::{Effects, Form};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::data::campaign::{DeclaredEffect, Knowledge};
use crate::digits::significant;
use crate::parameter::Parameter;

use super::rebound::{free_rebound, put_back, without_rebound};
use super::{Evidence, Finding, Fit, Statement, method_refusal};

/// χ² by which, beside two for each parameter more, another form of what is declared has to explain the wheels better.
const BETTER: f64 = 6.0;
/// Standard deviations by which a parameter is another.
const ANOTHER: f64 = 2.0;

/// Pa: no force tells such a cohesion from none.
const NO_COHESION_PA: f64 = 1.0;
/// χ² by which a soil without cohesion has to explain the wheels worse: two standard deviations.
const SHOWN: f64 = 4.0;

/// The posterior's mean and intervals.
///
/// # Errors
/// The refusal, in words; where too many parameters of effects are free.
pub fn map(evidence: &Evidence) -> Result<Finding, String> {
    let Fits { best: estimate, rivals } = in_all_forms(evidence)?;
    let mut finding = Finding::from(&estimate.identified);
    finding.cohesion_pa = of_logarithm(finding.cohesion_pa, estimate.ln_cohesion);
    finding.shear_modulus_m = of_logarithm(finding.shear_modulus_m, estimate.ln_shear_modulus);
    finding.fit = Some(fit(&estimate));
    let beliefs = [evidence.prior.ln_cohesion, evidence.prior.friction_angle_rad, evidence.prior.ln_shear_modulus];
    for (statement, belief) in finding.statements_mut().into_iter().zip(beliefs) {
        statement.assumed = belief.is_known();
    }
    for (id, without) in without_what_is_not_shown(evidence, &estimate) {
        doubt(&mut finding, &without, |other| {
            format!("{id} is declared and not shown by these data: {other} without it")
        });
    }
    for (form, rival) in rivals {
        doubt(&mut finding, &rival, |other| format!("{form} explains these data as well: {other} with it"));
    }
    if finding.cohesion_pa.identifiable && may_have_no_cohesion(evidence, &estimate) {
        finding.cohesion_pa.identifiable = false;
        let [_, most] = finding.cohesion_pa.interval_95;
        finding.remarks.push(format!("c may be nothing: these data say that it is at most {most:.0} Pa"));
    }
    Ok(finding)
}

/// Whether a soil without cohesion explains the wheels as well.
fn may_have_no_cohesion(evidence: &Evidence, estimate: &MapEstimate<f64>) -> bool {
    let prior = SoilPrior { ln_cohesion: Belief::known(NO_COHESION_PA.ln()), ..evidence.prior };
    let without = in_all_forms(&Evidence { prior, ..evidence.clone() });
    without.is_ok_and(|without| without.best.misfit - estimate.misfit < SHOWN * estimate.widened.powi(2))
}

/// Estimates without one of the declared effects each that explain the wheels as well as with it.
fn without_what_is_not_shown(
    evidence: &Evidence,
    estimate: &MapEstimate<f64>,
) -> Vec<(&'static str, MapEstimate<f64>)> {
    let without = |left_out: &DeclaredEffect| {
        let others = evidence.declared.iter().filter(|effect| effect.info.id != left_out.info.id);
        let found = in_all_forms(&Evidence { declared: others.cloned().collect(), ..evidence.clone() }).ok()?.best;
        (found.misfit <= estimate.misfit + BETTER).then_some((left_out.info.id, found))
    };
    evidence.declared.iter().filter_map(without).collect()
}

/// Says of parameters that they are not told where they are others by an estimate that explains the data as well; `in_words` says by which,
/// of how they are then.
fn doubt(finding: &mut Finding, rival: &MapEstimate<f64>, in_words: impl Fn(&str) -> String) {
    let other = Finding::from(&rival.identified);
    let mut names = Vec::new();
    let statements = finding.statements_mut().into_iter().zip(other.statements()).zip(Parameter::ALL);
    for ((statement, other), parameter) in statements {
        if statement.identifiable && (statement.value - other.value).abs() > ANOTHER * statement.std {
            statement.identifiable = false;
            let value = significant(parameter.shown(other.value), 3);
            names.push(format!("{} is {value} {}", parameter.symbol(), parameter.unit()));
        }
    }
    if !names.is_empty() {
        finding.remarks.push(in_words(&names.join(", ")));
    }
}

/// The soil of the greatest posterior probability; none where the method refuses.
pub fn most_probable_soil(evidence: &Evidence) -> Option<Soil<f64>> {
    in_all_forms(evidence).ok().map(|fits| fits.best.mode)
}

/// Estimates with the declared effects in the forms that they may have.
struct Fits {
    /// In the first forms, or in those that explain the wheels better by more than chance does.
    best: MapEstimate<f64>,
    /// In which other form of an effect chance may make them explained as well, in words, and what the estimate is then.
    rivals: Vec<(String, MapEstimate<f64>)>,
}

fn in_all_forms(evidence: &Evidence) -> Result<Fits, String> {
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
        let cost = estimate.misfit + 2.0 * declared.free.len() as f64;
        Ok::<_, String>((cost, estimate))
    };
    let first = fitted(&evidence.declared);
    let others = in_other_forms(evidence).into_iter();
    let mut others: Vec<(String, f64, MapEstimate<f64>)> = others
        .filter_map(|(form, effects)| fitted(&effects).ok().map(|(cost, estimate)| (form, cost, estimate)))
        .collect();
    others.sort_by(|one, other| one.1.total_cmp(&other.1));
    let takes_its_place = |least: f64| first.as_ref().map_or(true, |(cost, _)| least < cost - BETTER);
    let (cost, best) = match others.first() {
        Some((_, least, _)) if takes_its_place(*least) => {
            let (_, cost, estimate) = others.remove(0);
            (cost, estimate)
        }
        _ => first?,
    };
    let is_rival = |other: &(String, f64, MapEstimate<f64>)| other.1 < cost + BETTER;
    let rivals = others.into_iter().filter(is_rival).map(|(form, _, estimate)| (form, estimate)).collect();
    Ok(Fits { best, rivals })
}

/// The form that is stated, else the first that an effect may have of those whose columns are known.
fn first_form(evidence: &Evidence, effect: &DeclaredEffect) -> Option<&'static Form> {
    effect.form.or_else(|| effect.open_forms().find(|form| evidence.has(form))).or_else(|| effect.first_form())
}

/// The declared effects, one of them in another form that it may have, of those whose columns are known; and which, in words.
fn in_other_forms(evidence: &Evidence) -> Vec<(String, Vec<DeclaredEffect>)> {
    let effects = evidence.declared.as_slice();
    let other = |place: usize| {
        let effect = &effects[place];
        let first = first_form(evidence, effect).map(|form| form.name);
        effect.open_forms().filter(move |form| evidence.has(form) && Some(form.name) != first).map(move |form| {
            let mut effects = effects.to_vec();
            effects[place] = effects[place].in_form(form);
            (format!("{} in the form {}", effect.info.id, form.name), effects)
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
