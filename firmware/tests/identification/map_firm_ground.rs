//! Maximum a posteriori on ground far firmer than is believed.

use kapvik_firmware::identification::SoilPrior;
use kapvik_firmware::identification::map::identify;
use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::terramechanics::effects::Effects;
use rayon::prelude::*;

use super::map_design::{Design, WHEEL, drawn};
use super::worse::worse;

/// On soil so firm that wheels sink by a hundredth of their radius, far beyond what is believed of the stiffness, the way from the middle of
/// the beliefs to the mode is long: where it is lost, exact data seem to be of no soil. Without noise the truth leaves nothing but its
/// distance from what is believed, and a mode hardly ever more: without sinkage there is now and then another minimum that is as good as
/// chance would have it.
#[test]
fn firm_ground_is_found() {
    let prior = SoilPrior::usual();
    let beyond: Vec<f64> = (0..240_u64)
        .into_par_iter()
        .filter_map(|seed| {
            let mut soil = drawn(seed);
            soil.frictional_modulus *= 10.0 + (seed % 20) as f64;
            let design = Design { spread: 0.3, sinkage_seen: seed % 2 == 0, ..Design::MEAN_OF_100 };
            let seen = design.observe(&soil, &Effects::none(), 30_000 + seed, 0.0)?;
            let found = identify(&WHEEL, &seen, &prior).expect("an estimate");
            Some(found.misfit - distance(&soil, &prior))
        })
        .collect();
    let beside = beyond.iter().filter(|beyond| **beyond > 0.1).count();
    let farthest = beyond.iter().copied().fold(0.0, worse);
    println!("firm ground: {beside} of {} are in another minimum, by up to {farthest:.1}", beyond.len());
    assert!(beyond.len() > 200 && beside <= 5 && farthest < 16.0);
}

/// Sum of the squared distances of a soil's numbers from what is believed of them, in standard deviations.
fn distance(soil: &Soil<f64>, prior: &SoilPrior<f64>) -> f64 {
    let away = soil.sinkage_exponent - prior.sinkage_exponent.mean;
    let numbers = [
        (soil.sinkage_exponent, prior.sinkage_exponent),
        (soil.frictional_modulus.ln() + away * prior.known_depth_m.ln(), prior.ln_stiffness),
        (soil.peak_stress_c1, prior.peak_stress_c1),
        (soil.peak_stress_c2, prior.peak_stress_c2),
        (soil.shear_modulus_m.ln(), prior.ln_shear_modulus),
        (soil.friction_angle_rad, prior.friction_angle_rad),
        (soil.cohesion_pa.ln(), prior.ln_cohesion),
    ];
    numbers.into_iter().map(|(number, belief)| ((number - belief.mean) / belief.spread()).powi(2)).sum()
}
