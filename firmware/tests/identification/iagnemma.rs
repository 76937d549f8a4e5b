//! Iagnemma's line: what it finds, and when it says nothing.

use kapvik_firmware::identification::iagnemma::{IagnemmaAssumptions, iagnemma};
use kapvik_firmware::identification::{Assumed, Observation, Origin, Refusal};
use kapvik_firmware::wheel_state::WheelState;

use super::drawn::{ALTERNATING, any_pattern, draw, loaded};
use super::independent::CASES;
use super::made::{Normal, kapvik_wheel, seen, single, table_1_sand};
use super::worse::worse;

/// The true K, and c as told or held at zero.
pub fn assumptions(cohesion_pa: Option<f64>) -> IagnemmaAssumptions<f64> {
    IagnemmaAssumptions {
        shear_modulus_m: Assumed { value: 0.0114, std: 0.002 },
        cohesion_pa: cohesion_pa.map(|value| Assumed { value, std: 300.0 }),
    }
}

#[test]
fn an_independent_implementation_finds_the_same() {
    for case in &CASES {
        let told = iagnemma(&kapvik_wheel(), &case.observations(), &assumptions(None)).expect("an answer");
        let [c_pa, phi_deg] = case.iagnemma;
        assert!((told.cohesion_pa.value - c_pa).abs() < 1e-3, "{told:?}, not {c_pa} Pa");
        assert!((told.friction_angle_rad.value.to_degrees() - phi_deg).abs() < 1e-5, "{told:?}, not {phi_deg}°");
        assert_eq!((told.shear_modulus_m.value, told.shear_modulus_m.origin), (0.0114, Origin::Assumed));

        let told = iagnemma(&kapvik_wheel(), &case.observations(), &assumptions(Some(0.0))).expect("an answer");
        let phi_deg = case.iagnemma_without_cohesion_deg;
        assert!((told.friction_angle_rad.value.to_degrees() - phi_deg).abs() < 1e-5, "{told:?}, not {phi_deg}°");
        assert_eq!((told.cohesion_pa.value, told.cohesion_pa.origin), (0.0, Origin::Assumed));
    }
}

/// Residuals, their covariance and the singular values of the scaled columns, written out for three points; κ₁ and κ₂ by the
/// published formulas.
#[test]
fn standard_deviations_and_condition_number_are_those_of_the_line() {
    let (wheel, wheels) = (kapvik_wheel(), CASES[0].observations());
    let (r, b, k) = (wheel.radius_m, wheel.width_m, 0.0114);
    let points = wheels.map(|Observation { state, .. }| {
        let (w, t, s) = (state.load_n, state.torque_nm, state.slip);
        let entry = (1.0 - state.sinkage_m.expect("seen") / r).acos();
        let half = entry / 2.0;
        let kappa_1 = (w * r * entry * entry + 4.0 * t * entry.sin() - 8.0 * t * half.sin())
            / (2.0 * r * r * b * entry * (2.0 * half.cos() - entry.cos() - 1.0));
        let mobilised = 1.0 - (-r / k * (half + (1.0 - s) * (half.sin() - entry.sin()))).exp();
        [kappa_1, 2.0 * t / (r * r * b * entry * mobilised)]
    });
    let n = points.len() as f64;
    let mean = |number: &dyn Fn(&[f64; 2]) -> f64| points.iter().map(number).sum::<f64>() / n;
    let [mean_1, mean_2] = [mean(&|point| point[0]), mean(&|point| point[1])];
    let spread = mean(&|point| (point[0] - mean_1).powi(2));
    let slope = mean(&|point| (point[0] - mean_1) * (point[1] - mean_2)) / spread;
    let offset = mean_2 - slope * mean_1;
    let variance = mean(&|point| (point[1] - offset - slope * point[0]).powi(2)) * n / (n - 2.0);
    let std_slope = (variance / (n * spread)).sqrt();
    let std_offset = (variance / n * (1.0 + mean_1 * mean_1 / spread)).sqrt();
    // Singular values of two columns of unit length: √(1 ± their cosine).
    let cosine = mean_1 / (mean_1 * mean_1 + spread).sqrt();

    let told = iagnemma(&wheel, &wheels, &assumptions(None)).expect("an answer");
    let std_phi = std_slope / (1.0 + slope * slope);
    for (found, expected) in [
        (told.cohesion_pa.value, offset),
        (told.friction_angle_rad.value.tan(), slope),
        (told.cohesion_pa.std.expect("six points"), std_offset),
        (told.friction_angle_rad.std.expect("six points"), std_phi),
        (told.condition_number, ((1.0 + cosine) / (1.0 - cosine)).sqrt()),
    ] {
        assert!((found / expected - 1.0).abs() < 1e-9, "{found}, not {expected}");
    }
}

#[test]
fn a_negative_cohesion_is_told_and_not_identifiable() {
    let told = iagnemma(&kapvik_wheel(), &CASES[1].observations(), &assumptions(None)).expect("an answer");
    assert!(told.cohesion_pa.value < 0.0 && !told.cohesion_pa.identifiable, "{told:?}");
}

#[test]
fn single_precision_is_within_a_thousandth_of_a_standard_deviation() {
    let narrow = kapvik_wheel().map(|length| length as f32);
    let assumed = IagnemmaAssumptions { shear_modulus_m: Assumed { value: 0.0114_f32, std: 0.002 }, cohesion_pa: None };
    let mut random = Normal::new(4);
    let mut worst = 0.0_f64;
    for spread in [0.0, 0.08, 0.5] {
        for _ in 0..300 {
            let wheels = draw(&loaded(spread, &any_pattern(&mut random)), 1.0, &mut random);
            let double = iagnemma(&kapvik_wheel(), &wheels, &assumptions(None)).expect("an answer");
            let single = iagnemma(&narrow, &wheels.map(|wheel| single(&wheel)), &assumed).expect("an answer");
            for (double, single) in
                [(double.cohesion_pa, single.cohesion_pa), (double.friction_angle_rad, single.friction_angle_rad)]
            {
                let std = double.std.expect("six wheels");
                worst = worse(worst, (f64::from(single.value) - double.value).abs() / std);
            }
        }
    }
    println!("single is within {worst:.1e} σ of double");
    assert!(worst < 1e-3, "{worst}");
}

#[test]
fn each_refusal_has_its_reason() {
    let wheel = kapvik_wheel();
    let good = loaded(0.5, &ALTERNATING[0]);
    let method = |wheels: &[Observation<f64>]| iagnemma(&wheel, wheels, &assumptions(None)).map(|_| ());
    let but_first = |change: fn(&mut WheelState<f64>)| {
        let mut wheels = good;
        change(&mut wheels[0].state);
        method(&wheels)
    };
    assert_eq!(method(&good), Ok(()));
    assert_eq!(method(&good[..1]), Err(Refusal::TooFew { needed: 2 }));
    assert_eq!(method(&[seen(&table_1_sand(), 0.2, 65.4); 6]), Err(Refusal::NotIdentifiable));
    assert_eq!(but_first(|state| state.sinkage_m = None), Err(Refusal::NoSinkage));
    assert_eq!(but_first(|state| state.sinkage_m = Some(0.0)), Err(Refusal::OutOfRange));
    assert_eq!(but_first(|state| state.slip = 1.5), Err(Refusal::OutOfRange));
    assert_eq!(but_first(|state| state.torque_nm = 1e4), Err(Refusal::NegativeStress));
    assert_eq!(but_first(|state| state.load_n = f64::INFINITY), Err(Refusal::NotFinite));
    // A braking wheel is left out, and the drawbar pull is not looked at.
    assert_eq!(but_first(|state| state.slip = -0.1), method(&good[1..]));
    assert_eq!(but_first(|state| state.drawbar_pull_n = 1e6), Ok(()));
    let mut nothing = assumptions(None);
    nothing.shear_modulus_m.value = 0.0;
    assert_eq!(iagnemma(&wheel, &good, &nothing).map(|_| ()), Err(Refusal::OutOfRange));
    // One wheel is enough where c is assumed, but gives no residual to tell a standard deviation from.
    let told = iagnemma(&wheel, &good[..1], &assumptions(Some(0.0))).expect("an answer");
    assert!(told.friction_angle_rad.std.is_none() && !told.friction_angle_rad.identifiable);
}
