//! Limits with a closed form or a known sign.

use kapvik_firmware::terramechanics::{Contact, Soil, Wheel, wheel_forces};

use super::{forces, kapvik_wheel, reference, table_1_sand};

const SINKAGE_M: f64 = 0.018;

#[test]
fn soil_without_strength_resists_and_takes_no_torque() {
    let soil = Soil { cohesion_pa: 0.0, friction_angle_rad: 0.0, ..table_1_sand() };
    for slip in [-1.0, -0.5, 0.0, 0.5, 1.0] {
        let found = forces(&kapvik_wheel(), &soil, slip, SINKAGE_M);
        assert_eq!(found.torque_nm, 0.0);
        assert!(found.drawbar_pull_n < 0.0 && found.load_n > 0.0, "{slip}: {found:?}");
    }
}

/// For n = 1 and θm at the exit, σ = k r (cos θ − cos θ₁) alone: W and DP are elementary.
#[test]
fn linear_soil_without_strength_has_a_closed_form() {
    let wheel = kapvik_wheel();
    let soil = Soil {
        sinkage_exponent: 1.0,
        cohesion_pa: 0.0,
        friction_angle_rad: 0.0,
        peak_stress_c1: 0.0,
        peak_stress_c2: 0.0,
        ..table_1_sand()
    };
    let entry = (1.0 - SINKAGE_M / wheel.radius_m).acos();
    let factor = soil.stiffness(wheel.width_m) * wheel.radius_m.powi(2) * wheel.width_m;
    let load_n = factor * (0.5 * entry + 0.25 * (2.0 * entry).sin() - entry.cos() * entry.sin());
    let pull_n = -factor * 0.5 * (1.0 - entry.cos()).powi(2);
    let found = forces(&wheel, &soil, 0.3, SINKAGE_M);
    // The peak is held one millionth of the contact inside.
    assert!((found.load_n / load_n - 1.0).abs() < 2e-6, "{} {load_n}", found.load_n);
    assert!((found.drawbar_pull_n / pull_n - 1.0).abs() < 2e-6, "{} {pull_n}", found.drawbar_pull_n);
}

/// With K = 0 all strength is mobilised: T = r²b ∫(c + σ tan φ), and ∫σ follows from W and DP of a soil without strength.
#[test]
fn vanishing_shear_modulus_mobilises_all_strength() {
    let wheel = kapvik_wheel();
    let at_once = Soil { shear_modulus_m: 0.0, ..table_1_sand() };
    let nearly = Soil { shear_modulus_m: 1e-7, ..table_1_sand() };
    for slip in [0.2, 1.0] {
        let limit = forces(&wheel, &at_once, slip, SINKAGE_M);
        let expected = reference::forces(&wheel, &nearly, slip, SINKAGE_M);
        let tolerance = 2e-5 * expected.load_n;
        assert!((limit.load_n - expected.load_n).abs() < tolerance, "{limit:?} {expected:?}");
        assert!((limit.drawbar_pull_n - expected.drawbar_pull_n).abs() < tolerance, "{limit:?} {expected:?}");
        assert!((limit.torque_nm - expected.torque_nm).abs() < wheel.radius_m * tolerance, "{limit:?} {expected:?}");
    }
}

#[test]
fn locked_wheel_is_the_limit_of_braking() {
    let (wheel, soil) = (kapvik_wheel(), Soil { rebound_ratio: 0.3, ..table_1_sand() });
    let locked = forces(&wheel, &soil, -1.0, SINKAGE_M);
    let nearly = reference::forces(&wheel, &soil, -1.0 + 1e-7, SINKAGE_M);
    assert!((locked.load_n / nearly.load_n - 1.0).abs() < 1e-5, "{locked:?} {nearly:?}");
    assert!((locked.drawbar_pull_n / nearly.drawbar_pull_n - 1.0).abs() < 1e-5, "{locked:?} {nearly:?}");
    assert!((locked.torque_nm / nearly.torque_nm - 1.0).abs() < 1e-5, "{locked:?} {nearly:?}");
    // All of the rim shears backward: the torque is that of a spinning wheel with K = 0 and the same peak, reversed.
    let spinning =
        Soil { shear_modulus_m: 0.0, peak_stress_c1: soil.peak_stress_c1 - 2.0 * soil.peak_stress_c2, ..soil };
    let spun = forces(&wheel, &spinning, 1.0, SINKAGE_M);
    assert!((locked.torque_nm / spun.torque_nm + 1.0).abs() < 1e-9, "{locked:?} {spun:?}");
}

#[test]
fn without_contact_there_is_no_force() {
    for slip in [-1.0, -0.3, 0.0, 1.0] {
        let found = forces(&kapvik_wheel(), &table_1_sand(), slip, 0.0);
        assert_eq!([found.drawbar_pull_n, found.load_n, found.torque_nm], [0.0; 3]);
    }
}

#[test]
fn a_skidding_wheel_is_held_back() {
    let rolling = forces(&kapvik_wheel(), &table_1_sand(), 0.0, SINKAGE_M);
    let braking = forces(&kapvik_wheel(), &table_1_sand(), -0.5, SINKAGE_M);
    assert!(rolling.torque_nm > 0.0, "the rim of a free-rolling rigid wheel still shears soil forward: {rolling:?}");
    assert!(braking.torque_nm < 0.0 && braking.drawbar_pull_n < rolling.drawbar_pull_n, "{braking:?}");
}

/// Slip 0 is reached from both sides: 1 − i and 1/(1 + i) agree to first order.
#[test]
fn forces_are_continuous_at_zero_slip() {
    let at = |slip| forces(&kapvik_wheel(), &table_1_sand(), slip, SINKAGE_M);
    let (below, above) = (at(-1e-9), at(1e-9));
    assert!((below.drawbar_pull_n - above.drawbar_pull_n).abs() < 1e-5, "{below:?} {above:?}");
    assert!((below.torque_nm - above.torque_nm).abs() < 1e-6, "{below:?} {above:?}");
}

/// A peak that moves across a fixed angle changes the forces smoothly.
#[test]
fn load_is_smooth_in_the_place_of_the_peak() {
    let at = |c1| forces(&kapvik_wheel(), &Soil { peak_stress_c1: c1, ..table_1_sand() }, 0.2, SINKAGE_M).load_n;
    let slopes = [0.2, 0.3, 0.4].map(|c1| (at(c1 + 1e-6) - at(c1 - 1e-6)) / 2e-6);
    let coarse = [0.2, 0.3, 0.4].map(|c1| (at(c1 + 1e-2) - at(c1 - 1e-2)) / 2e-2);
    for (fine, coarse) in slopes.into_iter().zip(coarse) {
        assert!((fine - coarse).abs() < 0.02 * coarse.abs() + 1e-3, "{fine} {coarse}");
    }
}

#[test]
fn pull_grows_with_slip_at_low_slip() {
    let pulls = [0.0, 0.05, 0.1, 0.15, 0.2].map(|slip| forces(&kapvik_wheel(), &table_1_sand(), slip, SINKAGE_M));
    assert!(pulls.windows(2).all(|pair| pair[1].drawbar_pull_n > pair[0].drawbar_pull_n), "{pulls:?}");
}

#[test]
fn load_grows_with_sinkage_when_driving() {
    let wheel = kapvik_wheel();
    for slip in [0.0, 0.3, 0.9] {
        let loads: Vec<f64> = (0..=90)
            .map(|k| forces(&wheel, &table_1_sand(), slip, 0.01 * f64::from(k) * wheel.radius_m).load_n)
            .collect();
        assert!(loads.windows(2).all(|pair| pair[1] > pair[0]), "{slip}: {loads:?}");
    }
}

/// Small sinkages keep their digits: θ₁ → √(2 z/r) (1 + z/(12 r)) from the series of arccos.
#[test]
fn entry_angle_of_a_shallow_contact_keeps_its_digits() {
    let (wheel, soil) = (Wheel { radius_m: 1.0, width_m: 1.0 }, table_1_sand());
    for depth in [1e-14_f64, 1e-9, 1e-5] {
        let expected = (2.0 * depth).sqrt() * (1.0 + depth / 12.0);
        let entry = Contact::new(&wheel, &soil, 0.0, depth).entry_rad;
        assert!((entry / expected - 1.0).abs() < 1e-11, "{depth}: {entry} {expected}");
        let single = Wheel { radius_m: 1.0_f32, width_m: 1.0 };
        let entry = Contact::new(&single, &soil.map(|value| value as f32), 0.0, depth as f32).entry_rad;
        assert!((f64::from(entry) / expected - 1.0).abs() < 1e-6, "{depth}: {entry} {expected}");
    }
}

#[test]
fn inputs_outside_their_range_are_refused() {
    let (wheel, soil) = (kapvik_wheel(), table_1_sand());
    for slip in [-1.01, 1.01, f64::NAN, f64::INFINITY] {
        assert!(wheel_forces(&wheel, &soil, slip, SINKAGE_M).is_err());
    }
    for sinkage_m in [-1e-9, 0.0751, f64::NAN, f64::INFINITY] {
        assert!(wheel_forces(&wheel, &soil, 0.1, sinkage_m).is_err());
    }
    assert!(wheel_forces(&Wheel { radius_m: 0.0, ..wheel }, &soil, 0.1, 0.0).is_err());
    assert!(wheel_forces(&wheel, &Soil { shear_modulus_m: -1e-3, ..soil }, 0.1, SINKAGE_M).is_err());
    assert!(wheel_forces(&wheel, &Soil { frictional_modulus: 1e308, ..soil }, 0.1, SINKAGE_M).is_ok());
    assert!(
        wheel_forces(&wheel, &Soil { frictional_modulus: 1e308, friction_angle_rad: 1.57, ..soil }, 0.1, 0.07).is_err()
    );
}
