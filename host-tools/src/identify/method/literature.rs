//! The methods of the literature, as the library has them.

use kapvik_firmware::identification::ding::{DingBounds, ding as ding_fit};
use kapvik_firmware::identification::hutangkabodee::hutangkabodee as newton;
use kapvik_firmware::identification::iagnemma::{IagnemmaAssumptions, Recursive, iagnemma as line};
use kapvik_firmware::identification::ray::ray as multiple_model;
use kapvik_firmware::identification::{Assumed, Identified, Refusal};

use super::{Evidence, Finding, method_refusal};

/// What an equation of the recursive method counts for once the next has come: it remembers some fifty.
const FORGETTING: f64 = 0.98;

/// Decoupled analytical identification, c and φ being whatever the least squares say: as its published behaviour has it.
///
/// # Errors
/// The refusal, in words; so with all of these.
pub fn ding(evidence: &Evidence) -> Result<Finding, String> {
    ding_within(evidence, &DingBounds::usual().with_any_strength())
}

/// The same with 0 ≤ c and 0 ≤ tan φ ≤ 1.2, without which it is not fit for use.
pub fn ding_bounded(evidence: &Evidence) -> Result<Finding, String> {
    ding_within(evidence, &DingBounds::usual())
}

fn ding_within(evidence: &Evidence, bounds: &DingBounds<f64>) -> Result<Finding, String> {
    worded(ding_fit(&evidence.wheel, &evidence.observations, bounds))
}

/// Linearised stresses, K assumed.
pub fn iagnemma(evidence: &Evidence) -> Result<Finding, String> {
    worded(line(&evidence.wheel, &evidence.observations, &assumptions(evidence)))
}

/// The same, row after row.
pub fn iagnemma_recursive(evidence: &Evidence) -> Result<Finding, String> {
    let identified = || {
        let mut estimate = Recursive::new(&assumptions(evidence), FORGETTING)?;
        evidence.observations.iter().try_for_each(|seen| estimate.add(&evidence.wheel, seen))?;
        estimate.identified()
    };
    worded(identified())
}

/// Simpson's rule and damped Newton steps, c and n assumed.
pub fn hutangkabodee(evidence: &Evidence) -> Result<Finding, String> {
    let mut finding = worded(newton(&evidence.wheel, &evidence.observations, &evidence.assumed.soil))?;
    finding.cohesion_pa = finding.cohesion_pa.with_std(evidence.assumed.cohesion_std_pa);
    Ok(finding)
}

/// Multiple models, one for each soil of the catalogue.
pub fn ray(evidence: &Evidence) -> Result<Finding, String> {
    worded(multiple_model(&evidence.wheel, &evidence.observations, &evidence.bank))
}

fn assumptions(evidence: &Evidence) -> IagnemmaAssumptions<f64> {
    let assumed = &evidence.assumed;
    let shear_modulus_m = Assumed { value: assumed.soil.shear_modulus_m, std: assumed.shear_modulus_std_m };
    IagnemmaAssumptions { shear_modulus_m, cohesion_pa: None }
}

fn worded(identified: Result<Identified<f64>, Refusal>) -> Result<Finding, String> {
    identified.map(|identified| Finding::from(&identified)).map_err(method_refusal)
}
