//! What the intervals of the simpler methods lack on runs that are laid out as the one in question.

use kapvik_firmware::identification::{Belief, SoilPrior};
use kapvik_firmware::network::TARGETS;
use kapvik_firmware::terramechanics::Soil;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::identify::SensorNoise;
use crate::identify::combine::MeanState;
use crate::identify::layout::Layout;
use crate::identify::rehearsal::{REACH, Soils, missing};
use crate::identify::target::{Target, is_told};

use super::{Evidence, Finding, Method, Statement, by_itself};

/// The last states of a run that are rehearsed: methods that take more of them forget sooner.
const MOST_REHEARSED: usize = 240;

/// Soils of which all is believed but c, φ and K.
struct Believed<'a>(&'a SoilPrior<f64>);

/// Widens the intervals of a finding where the method is too sure of such runs, and says so in it.
pub fn rehearse(method: Method, evidence: &Evidence, states: &[MeanState], noise: &SensorNoise, finding: &mut Finding) {
    let stated = finding.statements().map(Target::from);
    if !method.is_simpler() || stated.iter().any(|target| !(target.value.is_finite() && target.std.is_finite())) {
        return;
    }
    let first = states.len().saturating_sub(MOST_REHEARSED);
    let layout = Layout::new(&evidence.wheel, &states[first..], noise);
    let last = evidence.from(first);
    // A network that answers near the middle of what it learned errs little on soils near its answers, and much on those that there are.
    let widths = if method == Method::Cross { believed(&stated) } else { stated.map(|target| target.std) };
    let found = missing(&layout, &Believed(&evidence.prior), &stated, widths, |states| {
        let again = by_itself(method, &last.seeing(states.iter().copied())).ok()?;
        let again = again.statements();
        Some(std::array::from_fn(|parameter| stated_as(&stated[parameter], again[parameter])))
    });
    let Some(mut missing) = found else {
        finding.remarks.push("not held against simulated soils: too few about this answer carry the wheel".to_owned());
        finding.statements_mut().into_iter().for_each(|statement| statement.identifiable = false);
        return;
    };
    let given = finding.statements().map(|statement| statement.assumed);
    missing.errors.iter_mut().zip(given).filter(|(_, given)| *given).for_each(|(errors, _)| *errors = [0.0; 2]);
    widen(finding, &stated, &missing.errors);
    finding.widened = missing.in_words("method's");
}

/// An answer with its own intervals, or where the method gives none, with those that were stated.
fn stated_as(stated: &Target, again: &Statement) -> Target {
    if again.std.is_finite() { Target::from(again) } else { stated.at(again.value) }
}

/// By how much c, φ and K are usually believed to be another than these, as standard deviations.
fn believed(stated: &[Target; TARGETS]) -> [f64; TARGETS] {
    let usual = SoilPrior::<f64>::usual();
    let [c, _, k] = stated.map(|target| target.value.abs());
    [c * usual.ln_cohesion.spread(), usual.friction_angle_rad.spread(), k * usual.ln_shear_modulus.spread()]
}

fn widen(finding: &mut Finding, stated: &[Target; TARGETS], errors: &[[f64; 2]; TARGETS]) {
    for (((statement, target), errors), believed) in
        finding.statements_mut().into_iter().zip(stated).zip(errors).zip(believed(stated))
    {
        if *errors == [0.0; 2] {
            continue;
        }
        let Target { std, intervals: [interval_68, interval_95], .. } =
            target.widened(*errors, [f64::NEG_INFINITY, f64::INFINITY], f64::INFINITY);
        let identifiable = statement.identifiable && is_told(std, believed);
        *statement = Statement { std, interval_68, interval_95, identifiable, ..*statement };
    }
}

impl From<&Statement> for Target {
    fn from(statement: &Statement) -> Self {
        Self { value: statement.value, std: statement.std, intervals: [statement.interval_68, statement.interval_95] }
    }
}

impl Soils for Believed<'_> {
    fn draw(&self, stated: &[Target; TARGETS], widths: &[f64; TARGETS], random: &mut ChaCha8Rng) -> Soil<f64> {
        let prior = self.0;
        let ends = |belief: &Belief<f64>| [belief.low.exp(), belief.high.exp()];
        let phi = &prior.friction_angle_rad;
        let bounds = [ends(&prior.ln_cohesion), [phi.low, phi.high], ends(&prior.ln_shear_modulus)];
        let mut within = |middle: f64, width: f64, [low, high]: [f64; 2]| {
            let share: f64 = random.random();
            (middle + REACH * width * (2.0 * share - 1.0)).clamp(low, high)
        };
        let [cohesion_pa, friction_angle_rad, shear_modulus_m] =
            std::array::from_fn(|place| within(stated[place].value, widths[place], bounds[place]));
        let mut any = |belief: &Belief<f64>| within(belief.mean, belief.spread(), [belief.low, belief.high]);
        let sinkage_exponent = any(&prior.sinkage_exponent);
        let other_exponent = sinkage_exponent - prior.sinkage_exponent.mean;
        let ln_stiffness = any(&prior.ln_stiffness) - other_exponent * prior.known_depth_m.ln();
        Soil {
            cohesion_pa,
            friction_angle_rad,
            shear_modulus_m,
            sinkage_exponent,
            frictional_modulus: ln_stiffness.exp(),
            cohesive_modulus: 0.0,
            peak_stress_c1: any(&prior.peak_stress_c1),
            peak_stress_c2: any(&prior.peak_stress_c2),
            rebound_ratio: any(&prior.rebound_ratio),
        }
    }

    fn targets(&self, soil: &Soil<f64>) -> [f64; TARGETS] {
        [soil.cohesion_pa, soil.friction_angle_rad, soil.shear_modulus_m]
    }
}
