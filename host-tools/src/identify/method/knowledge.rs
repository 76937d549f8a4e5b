//! What is believed of a soil: what a campaign says, or the prior that the networks were trained with.

use kapvik_firmware::identification::{Belief, SoilPrior};

use crate::data::campaign::{Campaign, Knowledge};
use crate::prior::{self, Range};

/// The usual prior, but for what a campaign's `[soil]` says.
pub fn soil_prior(campaign: &Campaign) -> SoilPrior<f64> {
    let usual = SoilPrior::usual();
    let ground = &campaign.ground;
    SoilPrior {
        ln_cohesion: logarithm(ground.cohesion_pa, usual.ln_cohesion),
        friction_angle_rad: number(ground.friction_angle_rad, usual.friction_angle_rad),
        ln_shear_modulus: logarithm(ground.shear_modulus_m, usual.ln_shear_modulus),
        ln_stiffness: logarithm(ground.stiffness(&campaign.wheel), usual.ln_stiffness),
        // Who states a stiffness states it beside the exponent, not at a depth.
        known_depth_m: if ground.stiffness(&campaign.wheel).is_some() { 1.0 } else { usual.known_depth_m },
        sinkage_exponent: number(ground.sinkage_exponent, usual.sinkage_exponent),
        peak_stress_c1: number(ground.peak_stress_c1, usual.peak_stress_c1),
        peak_stress_c2: number(ground.peak_stress_c2, usual.peak_stress_c2),
        rebound_ratio: number(ground.rebound_ratio, usual.rebound_ratio),
    }
}

/// The prior that the networks were trained with: flat between bounds.
pub fn training_prior() -> SoilPrior<f64> {
    let flat = |range: Range| {
        let ends = [range.low, range.high].map(|end| if range.logarithmic { end.ln() } else { end });
        Belief::flat(ends[0], ends[1])
    };
    SoilPrior {
        ln_cohesion: flat(prior::COHESION_PA),
        friction_angle_rad: flat(prior::FRICTION_ANGLE_RAD),
        ln_shear_modulus: flat(prior::SHEAR_MODULUS_M),
        ln_stiffness: flat(prior::STIFFNESS),
        known_depth_m: 1.0,
        sinkage_exponent: flat(prior::SINKAGE_EXPONENT),
        peak_stress_c1: flat(prior::PEAK_STRESS_C1),
        peak_stress_c2: flat(prior::PEAK_STRESS_C2),
        rebound_ratio: Belief::known(0.0),
    }
}

fn number(known: Option<Knowledge>, usual: Belief<f64>) -> Belief<f64> {
    match known {
        None => usual,
        Some(Knowledge::Value { value, std: 0.0 }) => Belief::known(value),
        Some(Knowledge::Value { value, std }) => {
            Belief { mean: value, std: Some(std), low: usual.low.min(value), high: usual.high.max(value) }
        }
        Some(Knowledge::Between { min, max }) => Belief::flat(min, max),
    }
}

/// Of the logarithm of a number that is not below zero.
fn logarithm(known: Option<Knowledge>, usual: Belief<f64>) -> Belief<f64> {
    // Below the usual range a number is as good as zero.
    let ln = |value: f64| value.max(usual.low.exp()).ln();
    match known {
        Some(Knowledge::Value { value, std }) => {
            number(Some(Knowledge::Value { value: ln(value), std: std / value.max(usual.low.exp()) }), usual)
        }
        Some(Knowledge::Between { min, max }) => Belief::flat(ln(min), ln(max).max(ln(min) + 1e-9)),
        None => usual,
    }
}
