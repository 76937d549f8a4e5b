//! Maximum a posteriori with errors in variables, against figures of an independent implementation and against truths drawn from
//! the prior.

use heapless::Vec as Fixed;
use kapvik_firmware::identification::map::{
    DeclaredEffects, Foreseen, FreeParameter, MapEstimate, identify, identify_declared, information,
};
use kapvik_firmware::identification::{Belief, Observation, Refusal, SoilPrior};
use kapvik_firmware::scalar::Scalar;
use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::terramechanics::effects::Effects;
use kapvik_firmware::wheel_state::{WheelNoise, WheelState};
use rayon::prelude::*;

use super::made::{NOISE, SIX_SLIPS};
use super::map_design::{Design, TABLE_1, WHEEL, assert_near, drawn, lose_pull, lose_torque};
use super::worse::worse;

fn quantile(values: impl Iterator<Item = f64>, share: f64) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * share).round() as usize]
}

fn median(estimates: &[MapEstimate<f64>], value: impl Fn(&MapEstimate<f64>) -> f64) -> f64 {
    quantile(estimates.iter().map(value), 0.5)
}

fn friction_deg(estimate: &MapEstimate<f64>) -> f64 {
    estimate.identified.friction_angle_rad.value.to_degrees()
}

fn modulus_mm(estimate: &MapEstimate<f64>) -> f64 {
    1e3 * estimate.identified.shear_modulus_m.value
}

/// Medians of an independent implementation. A degree of φ and half a millimetre of K is
/// what its unstated beliefs in n, k, c₁ and c₂ can make.
#[test]
fn six_wheels_near_the_prior_as_published() {
    for (spread, instants, friction, modulus) in
        [(0.08, 1.0, 31.2, 11.1), (0.08, 100.0, 31.8, 11.4), (0.5, 1.0, 31.3, 11.2), (0.5, 100.0, 31.8, 11.4)]
    {
        let found = Design { spread, instants, ..Design::ONE_INSTANT }.estimates(&TABLE_1, 100);
        assert_near(median(&found, friction_deg), friction, 1.0);
        assert_near(median(&found, modulus_mm), modulus, 0.5);
        assert!(found.iter().all(|estimate| estimate.settled));
    }
}

/// The same of a soil far from the prior. The published figures are modes; the mean lies nearer to the prior.
#[test]
fn six_wheels_far_from_the_prior_as_published() {
    let soil =
        Soil { cohesion_pa: 1500.0, friction_angle_rad: 25.0_f64.to_radians(), shear_modulus_m: 0.022, ..TABLE_1 };
    let found = Design::ONE_INSTANT.estimates(&soil, 100);
    assert_near(median(&found, |found| found.mode.friction_angle_rad.to_degrees()), 28.2, 1.0);
    assert_near(median(&found, |found| 1e3 * found.mode.shear_modulus_m), 22.6, 1.0);
    let found = Design::MEAN_OF_100.estimates(&soil, 100);
    assert_near(median(&found, |found| found.mode.friction_angle_rad.to_degrees()), 25.4, 1.0);
    assert_near(median(&found, |found| 1e3 * found.mode.shear_modulus_m), 22.2, 0.5);
    let cohesion = median(&found, |found| found.mode.cohesion_pa);
    assert!((1192.0..1500.0).contains(&cohesion), "{cohesion} Pa");
}

/// A single instant tells K, and neither c nor much of φ; a hundred tell both.
#[test]
fn identifiable_is_what_the_data_tell() {
    let told = |design: Design<'_>| {
        let found = design.estimates(&TABLE_1, 1).remove(0).identified;
        [found.cohesion_pa, found.friction_angle_rad, found.shear_modulus_m].map(|told| told.identifiable)
    };
    assert_eq!(told(Design::ONE_INSTANT), [false, true, true]);
    assert_eq!(told(Design { spread: 0.5, ..Design::MEAN_OF_100 }), [true, true, true]);
    assert_eq!(told(Design { slips: &[0.2], ..Design::ONE_INSTANT }), [false, false, true]);
}

/// Relative standard deviations of an independent implementation, with z and slip known, and for one wheel a condition number of
/// 1.6e4–3.5e4 in ln c, ln φ, ln K.
#[test]
fn cramer_rao_as_published() {
    let one = bound(&[0.2], 0.0, 1.0);
    assert_near(one.ln_cohesion_std, 360.0, 5.0);
    assert_near(one.friction_angle_std_rad / TABLE_1.friction_angle_rad, 3.15, 0.01);
    assert_near(one.ln_shear_modulus_std, 7.61, 0.01);
    let hundred = bound(&[0.2], 0.0, 100.0);
    assert_near(hundred.friction_angle_std_rad / TABLE_1.friction_angle_rad, 0.32, 0.01);
    assert_near(hundred.ln_shear_modulus_std, 0.76, 0.01);
    // Which loads within ±8 % is not published: within a fifth of the published figures with ours.
    for (slips, instants, cohesion, friction, modulus) in [
        ([0.2; 6], 100.0, 2.79, 0.06, 0.20),
        ([0.10, 0.15, 0.20, 0.25, 0.30, 0.35], 1.0, 10.46, 0.23, 0.15),
        (SIX_SLIPS, 1.0, 9.76, 0.21, 0.11),
    ] {
        let found = bound(&slips, 0.08, instants);
        assert_near(found.ln_cohesion_std, cohesion, 0.2 * cohesion);
        assert_near(found.friction_angle_std_rad / TABLE_1.friction_angle_rad, friction, 0.2 * friction);
        assert_near(found.ln_shear_modulus_std, modulus, 0.25 * modulus);
    }
}

fn bound(slips: &[f64], spread: f64, instants: f64) -> Foreseen<f64> {
    let known = |value: f64| Belief::known(value);
    let prior = SoilPrior {
        ln_cohesion: Belief::flat(-2.0, 12.0),
        friction_angle_rad: Belief::flat(0.02, 1.2),
        ln_shear_modulus: Belief::flat(-9.0, -1.0),
        ln_stiffness: known(14.0),
        sinkage_exponent: known(1.0),
        peak_stress_c1: known(0.3),
        peak_stress_c2: known(0.3),
        ..SoilPrior::usual()
    };
    let share = 1.0 / instants.sqrt();
    let noise = NOISE.map(|std| std * share);
    let noise = WheelNoise { slip: 1e-9, sinkage_m: 1e-9, ..noise };
    let loads = [-1.0, 0.6, -0.2, 1.0, -0.6, 0.2];
    let design: Vec<_> = slips
        .iter()
        .zip(loads)
        .map(|(&slip, share)| {
            let load_n = 65.4 * (1.0 + spread * share);
            let state = WheelState { drawbar_pull_n: 0.0, load_n, torque_nm: 0.0, slip, sinkage_m: Some(0.01) };
            Observation { state, noise }
        })
        .collect();
    information(&WHEEL, &TABLE_1, &design, &prior).expect("a bound")
}

/// Without noise, and with nothing believed but ranges, the truth is what is left, but for a small part of what the stated
/// noise leaves open: the mean of a range cut out of a bell is not its middle.
#[test]
fn noise_free_data_give_the_truth() {
    let flat = SoilPrior {
        ln_cohesion: Belief::flat(2.0, 10.0),
        friction_angle_rad: Belief::flat(0.1, 1.0),
        ln_shear_modulus: Belief::flat(-7.0, -2.5),
        ln_stiffness: Belief::flat(10.0, 18.0),
        sinkage_exponent: Belief::flat(0.3, 2.0),
        peak_stress_c1: Belief::flat(0.02, 0.9),
        peak_stress_c2: Belief::flat(-0.3, 0.9),
        ..SoilPrior::usual()
    };
    let slips = [-0.3, -0.1, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.15, 0.45];
    let design = Design { slips: &slips, spread: 0.5, instants: 1e4, sinkage_seen: true };
    let seen = design.observe(&TABLE_1, &Effects::none(), 1, 0.0).expect("carried");
    let found = identify(&WHEEL, &seen, &flat).expect("an estimate");
    assert!(found.settled && found.chi_squared < 0.01, "{found:?}");
    for (fitted, truth) in [
        (found.ln_cohesion, TABLE_1.cohesion_pa.ln()),
        (found.friction_angle_rad, TABLE_1.friction_angle_rad),
        (found.ln_shear_modulus, TABLE_1.shear_modulus_m.ln()),
        (found.sinkage_exponent, TABLE_1.sinkage_exponent),
        (found.peak_stress_c1, TABLE_1.peak_stress_c1),
        (found.peak_stress_c2, TABLE_1.peak_stress_c2),
    ] {
        assert_near(fitted.mean, truth, 0.1 * fitted.std);
        assert!(fitted.std < 0.03, "{fitted:?}");
    }
}

/// One wheel with everything else known, a condition number of 1.6e4–3.5e4 in ln c, ln φ and
/// ln K. In φ itself the column is 1/φ as long.
#[test]
fn condition_number_of_one_wheel_as_published() {
    let design = Design { slips: &[0.2], spread: 0.0, instants: 1.0, sinkage_seen: true };
    let mut seen = design.observe(&TABLE_1, &Effects::none(), 1, 0.0).expect("carried");
    seen[0].noise.slip = 1e-5;
    seen[0].noise.sinkage_m = 1e-6;
    let known = |value: f64| Belief::known(value);
    let about = |mean: f64, std: f64| Belief { mean, std: Some(std), low: mean - 3.0, high: mean + 3.0 };
    let prior = SoilPrior {
        ln_cohesion: about(TABLE_1.cohesion_pa.ln(), 0.1),
        friction_angle_rad: Belief { low: 0.1, high: 1.2, ..about(TABLE_1.friction_angle_rad, 0.01) },
        ln_shear_modulus: about(TABLE_1.shear_modulus_m.ln(), 0.1),
        ln_stiffness: known(TABLE_1.stiffness(WHEEL.width_m).ln()),
        sinkage_exponent: known(1.10),
        peak_stress_c1: known(0.18),
        peak_stress_c2: known(0.32),
        ..SoilPrior::usual()
    };
    let found = identify(&WHEEL, &seen, &prior).expect("an estimate").identified.condition_number;
    assert!((1.6e4..3.5e4 / 0.557).contains(&found), "{found}");
}

/// Where model, noise and beliefs hold, the stated intervals hold the truth as often as they say, and the misfit is
/// distributed as χ². Bounds are four standard errors of the share of some 700 cases.
#[test]
fn stated_intervals_hold_the_truth() {
    let (one, mean) = (Design::ONE_INSTANT, Design::MEAN_OF_100);
    let all: fn(&mut Observation<f64>) = |_| ();
    for (design, lose) in [(one, all), (mean, all), (mean, lose_torque), (mean, lose_pull)] {
        let cases: Vec<_> = (0..800)
            .into_par_iter()
            .filter_map(|seed| {
                let soil = drawn(seed);
                let mut seen = design.observe(&soil, &Effects::none(), 10_000 + seed, 1.0)?;
                seen.iter_mut().for_each(lose);
                let found = identify(&WHEEL, &seen, &SoilPrior::usual()).expect("an estimate");
                let errors = [
                    (soil.cohesion_pa.ln() - found.ln_cohesion.mean) / found.ln_cohesion.std,
                    (soil.friction_angle_rad - found.friction_angle_rad.mean) / found.friction_angle_rad.std,
                    (soil.shear_modulus_m.ln() - found.ln_shear_modulus.mean) / found.ln_shear_modulus.std,
                ];
                Some((errors, found.misfit / f64::from(found.degrees_of_freedom), found.degrees_of_freedom))
            })
            .collect();
        let count = cases.len() as f64;
        let share = |parameter: usize, stds: f64| {
            cases.iter().filter(|case| case.0[parameter].abs() < stds).count() as f64 / count
        };
        for parameter in 0..3 {
            println!("{parameter}: {:.3} {:.3}", share(parameter, 1.0), share(parameter, 2.0));
            assert_near(share(parameter, 1.0), 0.683, 4.0 * (0.683 * 0.317 / count).sqrt());
            assert_near(share(parameter, 2.0), 0.954, 4.0 * (0.954 * 0.046 / count).sqrt());
        }
        let misfit = cases.iter().map(|case| case.1).sum::<f64>() / count;
        let degrees_of_freedom = f64::from(cases[0].2);
        assert_near(misfit, 1.0, 4.0 * (2.0 / degrees_of_freedom / count).sqrt());
    }
}

/// Single precision, as in flight, is finite and beside double precision by a small part of what is not known.
#[test]
fn single_precision_is_near() {
    let designs = [Design::ONE_INSTANT, Design { sinkage_seen: false, ..Design::ONE_INSTANT }, Design::MEAN_OF_100];
    let distances: Vec<f64> = (0..750_u64)
        .into_par_iter()
        .filter_map(|seed| {
            let design = designs[seed as usize % designs.len()];
            let seen = design.observe(&drawn(seed), &Effects::none(), 20_000 + seed, 1.0)?;
            let single: Vec<Observation<f32>> = seen.iter().map(in_single_precision).collect();
            // The rounded input, so that the computation alone differs.
            let seen: Vec<Observation<f64>> = single.iter().map(in_double_precision).collect();
            let wheel = WHEEL.map(|length| f64::from(length as f32));
            let wide = identify(&wheel, &seen, &SoilPrior::usual()).expect("an estimate");
            let narrow = identify(&wheel.map(|length| length as f32), &single, &SoilPrior::usual()).expect("one");
            assert!(narrow.misfit.is_finite() && narrow.identified.condition_number.is_finite());
            let distance = [
                (narrow.ln_cohesion, wide.ln_cohesion),
                (narrow.friction_angle_rad, wide.friction_angle_rad),
                (narrow.ln_shear_modulus, wide.ln_shear_modulus),
            ]
            .map(|(narrow, wide)| {
                assert!(narrow.std.is_finite() && narrow.std > 0.0);
                (f64::from(narrow.mean) - wide.mean).abs() / wide.std
            });
            Some(distance.into_iter().fold(0.0, worse))
        })
        .collect();
    assert!(distances.len() >= 500);
    let (usual, rare) = (quantile(distances.iter().copied(), 0.5), quantile(distances.iter().copied(), 0.99));
    let worst = quantile(distances.iter().copied(), 1.0);
    println!("f32 from f64 in standard deviations: median {usual:.4}, 99 % {rare:.3}, worst {worst:.3}");
    assert!(rare < 0.25 && worst.is_finite(), "{rare} {worst}");
}

fn in_single_precision(observation: &Observation<f64>) -> Observation<f32> {
    let convert = |value: f64| value.to_f32();
    Observation { state: observation.state.map(convert), noise: observation.noise.map(convert) }
}

fn in_double_precision(observation: &Observation<f32>) -> Observation<f64> {
    Observation { state: observation.state.map(f64::from), noise: observation.noise.map(f64::from) }
}

/// Slip-sinkage of n₁ = 0.3: told of it, the method finds n₁ and the soil; not told, its misfit says that something is
/// amiss.
#[test]
fn declared_effects_are_fitted_along() {
    let mut world = Effects::none();
    assert!(world.set("slip-sinkage", "n1", 0.3));
    let design = Design { spread: 0.5, ..Design::MEAN_OF_100 };
    let belief = Belief { mean: 0.0, std: Some(0.3), low: -0.5, high: 1.5 };
    let mut declared = DeclaredEffects::none();
    assert!(declared.effects.add("slip-sinkage"));
    declared.free = Fixed::from_slice(&[FreeParameter { effect: "slip-sinkage", parameter: "n1", belief }]).unwrap();
    let seen = design.observe(&TABLE_1, &world, 3, 1.0).expect("carried");
    let prior = SoilPrior::usual();
    let told = identify_declared(&WHEEL, &seen, &[], &prior, &declared).expect("an estimate");
    assert_near(told.effects[0].mean, 0.3, 3.0 * told.effects[0].std);
    assert!(told.effects[0].std < 0.1, "{told:?}");
    assert_near(told.friction_angle_rad.mean, TABLE_1.friction_angle_rad, 3.0 * told.friction_angle_rad.std);
    assert!(told.misfit < 40.0, "{told:?}");
    let untold = identify(&WHEEL, &seen, &prior).expect("an estimate");
    assert!(untold.misfit > 2.0 * told.misfit, "{} {}", untold.misfit, told.misfit);
    assert_eq!(told.widened, 1.0);
    let ratio = (untold.misfit / f64::from(untold.degrees_of_freedom)).sqrt();
    assert_near(untold.widened, ratio, 1e-12);
}

/// An effect that is neutral and not fitted changes nothing but rounding, and none at all nothing.
#[test]
fn neutral_effects_change_nothing() {
    let seen = Design::ONE_INSTANT.observe(&TABLE_1, &Effects::none(), 4, 1.0).expect("carried");
    let prior = SoilPrior::usual();
    let plain = identify(&WHEEL, &seen, &prior).expect("an estimate");
    let none = identify_declared(&WHEEL, &seen, &[], &prior, &DeclaredEffects::none()).expect("an estimate");
    assert_eq!(plain, none);
    let mut declared = DeclaredEffects::none();
    assert!(declared.effects.add("slip-sinkage"));
    let neutral = identify_declared(&WHEEL, &seen, &[], &prior, &declared).expect("an estimate");
    assert_near(neutral.friction_angle_rad.mean, plain.friction_angle_rad.mean, 1e-6);
    assert_near(neutral.ln_cohesion.mean, plain.ln_cohesion.mean, 1e-4);
}

#[test]
fn refuses_for_a_reason() {
    let seen = Design::ONE_INSTANT.observe(&TABLE_1, &Effects::none(), 5, 1.0).expect("carried");
    let prior = SoilPrior::usual();
    assert_eq!(identify(&WHEEL, &[], &prior), Err(Refusal::TooFew { needed: 1 }));
    let many: Vec<_> = core::iter::repeat_n(seen[0], 25).collect();
    assert_eq!(identify(&WHEEL, &many, &prior), Err(Refusal::TooMany { room: 24 }));
    let mut broken = seen.clone();
    broken[2].state.torque_nm = f64::NAN;
    assert_eq!(identify(&WHEEL, &broken, &prior), Err(Refusal::NotFinite));
    let upside_down = SoilPrior { friction_angle_rad: Belief::flat(1.0, 0.5), ..prior };
    assert_eq!(identify(&WHEEL, &seen, &upside_down), Err(Refusal::OutOfRange));
    let belief = Belief::flat(0.0, 1.0);
    let mut declared = DeclaredEffects::none();
    declared.free = Fixed::from_slice(&[FreeParameter { effect: "gravity waves", parameter: "n1", belief }]).unwrap();
    assert_eq!(identify_declared(&WHEEL, &seen, &[], &prior, &declared), Err(Refusal::OutOfRange));
}

/// What is known stays as it is, and tells the rest: with c known, φ is known better.
#[test]
fn a_known_cohesion_is_kept() {
    let seen = Design::MEAN_OF_100.observe(&TABLE_1, &Effects::none(), 6, 1.0).expect("carried");
    let free = identify(&WHEEL, &seen, &SoilPrior::usual()).expect("an estimate");
    let prior = SoilPrior { ln_cohesion: Belief::known(250.0_f64.ln()), ..SoilPrior::usual() };
    let known = identify(&WHEEL, &seen, &prior).expect("an estimate");
    assert_near(known.identified.cohesion_pa.value, 250.0, 1e-9);
    assert!(known.friction_angle_rad.std < 0.7 * free.friction_angle_rad.std);
    assert_near(known.friction_angle_rad.mean, TABLE_1.friction_angle_rad, 3.0 * known.friction_angle_rad.std);
}
