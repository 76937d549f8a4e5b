//! Answers that are no soil: what least squares say that know no bounds.

use super::{Finding, Statement};

/// The steepest friction angle that is one, rad: 60°, more than that of any loose soil.
const STEEPEST_RAD: f64 = 60.0 * std::f64::consts::PI / 180.0;
/// Standard deviations below zero from which noise is no excuse for a cohesion.
const EXCUSED: f64 = 2.0;
/// Standard deviations of c (Pa), φ (rad) and K (m) that are as good as zero: methods that choose among soils state 1e-60, which
/// only says that no soil of theirs is near.
const NO_SPREAD: [f64; 3] = [1e-2, 1e-6, 1e-8];

/// Where an answer is no soil, says why, and calls nothing in it identifiable: what one parameter errs by, the others make up for.
pub fn doubt(finding: &mut Finding) {
    finding.no_soil = why(finding);
    if finding.no_soil.is_some() {
        finding.statements_mut().into_iter().for_each(|statement| statement.identifiable = false);
    }
}

/// Why an answer is no soil; none where it is one. What the method takes as given is not its answer.
fn why(finding: &Finding) -> Option<String> {
    let Finding { cohesion_pa: c, friction_angle_rad: phi, shear_modulus_m: k, .. } = finding;
    let said = |statement: &Statement| !statement.assumed;
    let lacks_spread = finding
        .statements()
        .into_iter()
        .zip(NO_SPREAD)
        .any(|(one, none)| said(one) && !(one.std > none && one.std.is_finite()));
    let wrong = [
        (said(c) && (c.value.is_nan() || c.value < -EXCUSED * c.std), "c is below zero"),
        (said(phi) && !(0.0..=STEEPEST_RAD).contains(&phi.value), "φ is not from 0 to 60°"),
        (said(k) && (k.value.is_nan() || k.value <= 0.0), "K is not above zero"),
        (lacks_spread, "a standard deviation of the method's own is missing or zero"),
    ];
    let wrong: Vec<&str> = wrong.into_iter().filter(|(is_wrong, _)| *is_wrong).map(|(_, words)| words).collect();
    (!wrong.is_empty()).then(|| wrong.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 500 ± 300 Pa, 30 ± 2°, 12 ± 3 mm, all told; changed.
    fn doubted(change: impl Fn(&mut Finding)) -> Finding {
        let told = |value, std| Statement { identifiable: true, ..Statement::normal(value, std) };
        let mut finding = Finding::of([told(500.0, 300.0), told(0.52, 0.035), told(0.012, 0.003)]);
        change(&mut finding);
        doubt(&mut finding);
        finding
    }

    fn is_told(finding: &Finding) -> bool {
        finding.no_soil.is_none() && finding.statements().iter().all(|statement| statement.identifiable)
    }

    fn says(finding: &Finding, words: &str) {
        let why = finding.no_soil.as_deref().unwrap_or("nothing");
        assert!(why.contains(words), "{why}");
        assert!(finding.statements().iter().all(|statement| !statement.identifiable), "{why}");
    }

    #[test]
    fn a_soil_stays_told() {
        assert!(is_told(&doubted(|_| ())));
        assert!(is_told(&doubted(|finding| finding.cohesion_pa.value = -590.0)), "within two standard deviations");
        let given = doubted(|finding| {
            finding.shear_modulus_m = Statement { assumed: true, std: 0.0, ..finding.shear_modulus_m }
        });
        assert!(given.no_soil.is_none(), "what is given may be exact");
    }

    #[test]
    fn what_is_no_soil_tells_nothing() {
        says(&doubted(|finding| finding.cohesion_pa.value = -43e3), "c is below zero");
        says(&doubted(|finding| finding.friction_angle_rad.value = 62_f64.to_radians()), "φ is not from 0 to 60°");
        says(&doubted(|finding| finding.friction_angle_rad.value = -0.56), "φ is not from 0 to 60°");
        says(&doubted(|finding| finding.shear_modulus_m.value = 0.0), "K is not above zero");
        for std in [0.0, 1e-60, f64::INFINITY, f64::NAN] {
            says(&doubted(|finding| finding.friction_angle_rad.std = std), "standard deviation");
        }
    }
}
