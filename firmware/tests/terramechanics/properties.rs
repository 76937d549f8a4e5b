//! Whatever goes in, nothing panics and nothing that is not a number comes out.

use kapvik_firmware::terramechanics::{Soil, Wheel, greatest_load, sinkage_for_load, wheel_forces};
use proptest::prelude::*;

fn any_soil() -> impl Strategy<Value = Soil<f64>> {
    let number = || prop_oneof![any::<f64>(), -2.0..2.0, 0.0..1e-3, -1e6..1e6, Just(0.0)];
    prop::array::uniform9(number()).prop_map(|[n, k_c, k_phi, c, phi, k, c1, c2, eta]| Soil {
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

fn any_length() -> impl Strategy<Value = f64> {
    prop_oneof![any::<f64>(), 1e-3..1.0, Just(0.0)]
}

fn any_slip() -> impl Strategy<Value = f64> {
    prop_oneof![any::<f64>(), -1.0..=1.0, -1.0..-0.999_999, Just(-1.0), Just(0.0), Just(1.0)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn forces_are_numbers_or_an_error(soil in any_soil(), r in any_length(), b in any_length(), slip in any_slip(), depth in 0.0..1.0) {
        if let Ok(found) = wheel_forces(&Wheel { radius_m: r, width_m: b }, &soil, slip, depth * r) {
            prop_assert!(found.drawbar_pull_n.is_finite() && found.load_n.is_finite() && found.torque_nm.is_finite());
        }
        let wheel = Wheel { radius_m: r, width_m: b }.map(|length| length as f32);
        if let Ok(found) = wheel_forces(&wheel, &soil.map(|value| value as f32), slip as f32, depth as f32 * wheel.radius_m) {
            prop_assert!(found.drawbar_pull_n.is_finite() && found.load_n.is_finite() && found.torque_nm.is_finite());
        }
    }

    #[test]
    fn a_sinkage_is_in_range_or_an_error(soil in any_soil(), r in any_length(), b in any_length(), slip in any_slip(), load_n in prop_oneof![any::<f64>(), 1e-3..1e4]) {
        let wheel = Wheel { radius_m: r, width_m: b };
        if let Ok(z) = sinkage_for_load(&wheel, &soil, slip, load_n) {
            prop_assert!(z >= 0.0 && z <= r);
        }
        if let Ok(most) = greatest_load(&wheel, &soil, slip) {
            prop_assert!(most.load_n.is_finite() && most.sinkage_m >= 0.0 && most.sinkage_m <= r);
        }
        let wheel = Wheel { radius_m: r, width_m: b }.map(|length| length as f32);
        if let Ok(z) = sinkage_for_load(&wheel, &soil.map(|value| value as f32), slip as f32, load_n as f32) {
            prop_assert!(z >= 0.0 && z <= wheel.radius_m);
        }
    }
}
