//! Figures published of Iagnemma's identification, computed by an independent implementation that does not state which
//! wheel carried how much: medians and quartiles over draws of the noise.

use kapvik_firmware::identification::Observation;
use kapvik_firmware::identification::iagnemma::iagnemma;
use kapvik_firmware::terramechanics::{Wheel, sinkage_for_load, wheel_forces};
use kapvik_firmware::wheel_state::WheelState;

use super::drawn::{ALTERNATING, Published, any_pattern, by_pattern, could_be_one_more, loaded};
use super::iagnemma::assumptions;
use super::made::{NOISE, Normal, SIX_SLIPS, kapvik_wheel, table_1_sand};

/// c (Pa) and φ (degrees) on Kapvik's wheel, K given.
fn told(wheel: &Wheel<f64>, wheels: &[Observation<f64>]) -> [f64; 2] {
    let told = iagnemma(wheel, wheels, &assumptions(None)).expect("an answer");
    [told.cohesion_pa.value, told.friction_angle_rad.value.to_degrees()]
}

/// Whether the figures of φ (degrees) and c (Pa) could be those of one more pattern of loads.
fn check(spread: f64, instants: f64, phi: Published, c: Published) {
    let method = |wheels: &[Observation<f64>]| iagnemma(&kapvik_wheel(), wheels, &assumptions(None));
    let outcomes = by_pattern(spread, instants, &method);
    println!("±{spread}, {instants} instants");
    let could_be = [
        could_be_one_more("  φ", &outcomes, |outcome| outcome.friction_deg, phi),
        could_be_one_more("  c", &outcomes, |outcome| outcome.cohesion_pa, c),
    ];
    assert_eq!(could_be, [[true; 3]; 2]);
}

const NONE: Published = [None; 3];

#[test]
fn one_instant_at_a_spread_of_8_percent() {
    check(0.08, 1.0, [Some(36.3), Some(44.2), Some(48.5)], NONE);
}

#[test]
fn a_hundred_instants_at_a_spread_of_8_percent() {
    check(0.08, 100.0, [Some(34.8), Some(35.6), Some(36.4)], NONE);
}

#[test]
fn one_instant_at_a_spread_of_50_percent() {
    check(0.5, 1.0, [Some(29.6), Some(31.8), Some(34.7)], NONE);
}

#[test]
fn a_hundred_instants_at_a_spread_of_50_percent() {
    check(0.5, 100.0, [None, Some(31.9), None], [None, Some(1030.0), None]);
}

/// Published: c −2191 Pa, φ 35.7°.
#[test]
fn without_noise_at_a_spread_of_8_percent() {
    let mut random = Normal::new(20);
    let patterns: Vec<_> = ALTERNATING.into_iter().chain((0..100).map(|_| any_pattern(&mut random))).collect();
    let told: Vec<_> = patterns.iter().map(|pattern| told(&kapvik_wheel(), &loaded(0.08, pattern))).collect();
    println!("alternating: {:.1?}", &told[..2]);
    let nearest = told.iter().min_by(|a, b| (a[0] + 2191.0).abs().total_cmp(&(b[0] + 2191.0).abs())).expect("some");
    println!("nearest to −2191 Pa: {nearest:.1?}");
    assert!((nearest[0] + 2191.0).abs() < 100.0 && (nearest[1] - 35.7).abs() < 0.2, "{nearest:?}");
}

/// "Force c = 0: φ 33–34°."
#[test]
fn with_cohesion_held_at_zero() {
    let mut random = Normal::new(21);
    for spread in [0.0, 0.08, 0.5] {
        for _ in 0..20 {
            let wheels = loaded(spread, &any_pattern(&mut random));
            let told = iagnemma(&kapvik_wheel(), &wheels, &assumptions(Some(0.0))).expect("an answer");
            let phi_deg = told.friction_angle_rad.value.to_degrees();
            assert!((32.5..34.5).contains(&phi_deg), "{phi_deg}");
        }
    }
}

/// Ding's wheel at six slips under each load, without noise.
fn on_dings_wheel(loads_n: &[f64]) -> [f64; 2] {
    let (wheel, soil) = (Wheel { radius_m: 0.157, width_m: 0.165 }, table_1_sand());
    let one = |slip: f64, load_n: f64| {
        let sinkage_m = sinkage_for_load(&wheel, &soil, slip, load_n).expect("carried");
        let forces = wheel_forces(&wheel, &soil, slip, sinkage_m).expect("in range");
        let (drawbar_pull_n, torque_nm) = (forces.drawbar_pull_n, forces.torque_nm);
        Observation {
            state: WheelState { drawbar_pull_n, load_n, torque_nm, slip, sinkage_m: Some(sinkage_m) },
            noise: NOISE,
        }
    };
    let wheels: Vec<_> =
        SIX_SLIPS.into_iter().flat_map(|slip| loads_n.iter().map(move |load_n| one(slip, *load_n))).collect();
    told(&wheel, &wheels)
}

/// Published: loads of 30, 80 and 150 N: c 600 Pa, φ 32.5°; equal loads: c −9.8 kPa, φ 51.9°, the load not stated.
#[test]
fn on_dings_wheel_the_spread_of_the_loads_decides() {
    let spread = on_dings_wheel(&[30.0, 80.0, 150.0]);
    println!("30, 80 and 150 N: {spread:.1?}");
    assert!((spread[0] - 600.0).abs() < 50.0 && (spread[1] - 32.5).abs() < 0.15, "{spread:?}");
    let equal = [65.0, 80.0, 90.0].map(|load_n| on_dings_wheel(&[load_n]));
    println!("equal loads of 65, 80 and 90 N: {equal:.1?}");
    let [light, .., heavy] = equal;
    assert!(light[0] > -9800.0 && heavy[0] < -9800.0 && light[1] > 51.9 && heavy[1] < 51.9, "{equal:?}");
}
