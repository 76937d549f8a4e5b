//! Whatever goes in, nothing panics and nothing that is not a number comes out.

use std::sync::atomic::{AtomicU32, Ordering};

use kapvik_firmware::scalar::Scalar;
use kapvik_firmware::terramechanics::{Soil, Wheel, WheelForces, greatest_load, sinkage_for_load, wheel_forces};
use proptest::prelude::*;

use super::mostly::mostly;

/// Of each property.
const CASES: u32 = 2000;
/// Of these so many are answered, where more than half are expected to be: a quarter of the cases has no wild number, and not every wild one
/// is refused.
const LEAST_ANSWERED: u32 = CASES * 2 / 5;

fn any_soil() -> impl Strategy<Value = Soil<f64>> {
    let moduli = (mostly(0.3..1.6), mostly(0.0..1e5), mostly(1e5..5e6));
    let strength = (mostly(0.0..5e3), mostly(0.2..0.8), mostly(1e-3..0.05));
    let contact = (mostly(0.15..0.5), mostly(0.0..0.5), mostly(0.0..0.5));
    (moduli, strength, contact).prop_map(|((n, k_c, k_phi), (c, phi, k), (c1, c2, eta))| Soil {
        sinkage_exponent: n,
        cohesive_modulus: k_c,
        frictional_modulus: k_phi,
        cohesion_pa: c,
        friction_angle_rad: phi,
        shear_modulus_m: k,
        peak_stress_c1: c1,
        peak_stress_c2: c2,
        rebound_ratio: eta,
    })
}

fn any_wheel() -> impl Strategy<Value = Wheel<f64>> {
    (mostly(0.03..0.5), mostly(0.03..0.5)).prop_map(|(radius_m, width_m)| Wheel { radius_m, width_m })
}

fn any_slip() -> impl Strategy<Value = f64> {
    let edges = prop_oneof![-1.0..-0.999_999, Just(-1.0), Just(0.0), Just(1.0)];
    mostly(prop_oneof![3 => -1.0..=1.0, 1 => edges])
}

fn are_numbers<S: Scalar>(forces: &WheelForces<S>) -> bool {
    forces.drawbar_pull_n.is_finite() && forces.load_n.is_finite() && forces.torque_nm.is_finite()
}

/// Cases that a property answered, in both precisions.
#[derive(Debug, Default)]
struct Answered([AtomicU32; 2]);

impl Answered {
    const fn none() -> Self {
        Self([const { AtomicU32::new(0) }; 2])
    }

    fn count(&self, precision: usize) {
        self.0[precision].fetch_add(1, Ordering::Relaxed);
    }

    fn is_enough(&self) -> bool {
        println!("{self:?} of {CASES} cases were answered in double and in single precision");
        self.0.iter().all(|count| count.load(Ordering::Relaxed) >= LEAST_ANSWERED)
    }
}

static FORCES: Answered = Answered::none();
static SINKAGES: Answered = Answered::none();

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES))]

    fn forces_are_numbers(soil in any_soil(), wheel in any_wheel(), slip in any_slip(), depth in mostly(0.0..1.0)) {
        if let Ok(found) = wheel_forces(&wheel, &soil, slip, depth * wheel.radius_m) {
            prop_assert!(are_numbers(&found), "{found:?}");
            FORCES.count(0);
        }
        let wheel = wheel.map(|length| length as f32);
        if let Ok(found) = wheel_forces(&wheel, &soil.map(|value| value as f32), slip as f32, depth as f32 * wheel.radius_m) {
            prop_assert!(are_numbers(&found), "{found:?}");
            FORCES.count(1);
        }
    }

    fn sinkages_are_in_range(soil in any_soil(), wheel in any_wheel(), slip in any_slip(), load_n in mostly(1.0..300.0)) {
        if let Ok(z) = sinkage_for_load(&wheel, &soil, slip, load_n) {
            prop_assert!(z >= 0.0 && z <= wheel.radius_m);
            SINKAGES.count(0);
        }
        if let Ok(most) = greatest_load(&wheel, &soil, slip) {
            prop_assert!(most.load_n.is_finite() && most.sinkage_m >= 0.0 && most.sinkage_m <= wheel.radius_m);
        }
        let wheel = wheel.map(|length| length as f32);
        if let Ok(z) = sinkage_for_load(&wheel, &soil.map(|value| value as f32), slip as f32, load_n as f32) {
            prop_assert!(z >= 0.0 && z <= wheel.radius_m);
            SINKAGES.count(1);
        }
    }
}

#[test]
fn forces_are_numbers_or_an_error() {
    forces_are_numbers();
    assert!(FORCES.is_enough(), "{FORCES:?}");
}

#[test]
fn a_sinkage_is_in_range_or_an_error() {
    sinkages_are_in_range();
    assert!(SINKAGES.is_enough(), "{SINKAGES:?}");
}
