//! The Cramér–Rao bound of a situation: what no unbiased estimator of c, φ and K can beat.

use kapvik_firmware::identification::map::information;
use kapvik_firmware::identification::{Belief, SoilPrior};

use crate::parameter::Parameter;

use super::case::Case;

/// Root mean square over the cases of the bound's standard deviations: c (Pa), φ (°), K (mm). Nothing is believed of these
/// three; stiffness, exponent and peak position are believed as the prior has them, with a normal spread. None where no
/// case has a bound.
pub fn cramer_rao(cases: &[Case]) -> Option<[f64; 3]> {
    let bounds: Vec<[f64; 3]> = cases.iter().filter_map(bound).collect();
    let mean_square = |place: usize| bounds.iter().map(|bound| bound[place].powi(2)).sum::<f64>() / bounds.len() as f64;
    (!bounds.is_empty()).then(|| [0, 1, 2].map(|place| mean_square(place).sqrt()))
}

fn bound(case: &Case) -> Option<[f64; 3]> {
    let Case { evidence, soil, .. } = case;
    let told = information(&evidence.wheel, soil, &evidence.observations, &without_strength(&evidence.prior)).ok()?;
    Some([
        Parameter::Cohesion.shown(soil.cohesion_pa * told.ln_cohesion_std),
        Parameter::FrictionAngle.shown(told.friction_angle_std_rad),
        Parameter::ShearModulus.shown(soil.shear_modulus_m * told.ln_shear_modulus_std),
    ])
}

fn without_strength(prior: &SoilPrior<f64>) -> SoilPrior<f64> {
    let nothing = |belief: &Belief<f64>| Belief { std: None, ..*belief };
    let normal = |belief: &Belief<f64>| Belief { std: Some(belief.spread()), ..*belief };
    SoilPrior {
        ln_cohesion: nothing(&prior.ln_cohesion),
        friction_angle_rad: nothing(&prior.friction_angle_rad),
        ln_shear_modulus: nothing(&prior.ln_shear_modulus),
        ln_stiffness: normal(&prior.ln_stiffness),
        known_depth_m: prior.known_depth_m,
        sinkage_exponent: normal(&prior.sinkage_exponent),
        peak_stress_c1: normal(&prior.peak_stress_c1),
        peak_stress_c2: normal(&prior.peak_stress_c2),
        rebound_ratio: prior.rebound_ratio,
    }
}
