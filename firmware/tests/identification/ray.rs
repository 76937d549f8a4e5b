//! Ray's method: the right soil of a bank, a change of soil, and a soil that is not in the bank.

use kapvik_firmware::identification::ray::{MultipleModel, ray};
use kapvik_firmware::identification::{Observation, Refusal};
use kapvik_firmware::terramechanics::{Soil, sinkage_for_load};

use super::made::{EQUAL_LOAD_N, Normal, averaged, kapvik_wheel, noisy, seen, single, six_wheels, table_1_sand};

/// Soils of the literature (kPa, degrees, mm), with the K and the c₁, c₂ of the seed's sand where a source has none: the
/// seed's sand, dry sand (Iagnemma), sandy loam 15 %, clayey soil (Thailand), snow (Sweden), Upland sandy loam, the lunar
/// nominal soil.
fn bank() -> [Soil<f64>; 7] {
    [
        table_1_sand(),
        soil(1.1, 0.9, 1523.4, 1.0, 30.0, 25.0),
        soil(0.7, 5.27, 1515.04, 1.72, 29.0, 25.0),
        soil(0.5, 13.19, 692.15, 4.14, 13.0, 10.0),
        soil(1.44, 10.55, 66.08, 6.0, 20.7, 20.0),
        soil(1.1, 74.6, 2080.0, 3.3, 33.7, 25.0),
        soil(1.0, 1.4, 820.0, 0.17, 35.0, 18.0),
    ]
}

fn soil(n: f64, k_c: f64, k_phi: f64, c: f64, phi: f64, shear_modulus_mm: f64) -> Soil<f64> {
    Soil {
        sinkage_exponent: n,
        cohesive_modulus: 1e3 * k_c,
        frictional_modulus: 1e3 * k_phi,
        cohesion_pa: 1e3 * c,
        friction_angle_rad: phi.to_radians(),
        shear_modulus_m: 1e-3 * shear_modulus_mm,
        ..table_1_sand()
    }
}

/// The place of the likeliest soil.
fn likeliest<S: PartialOrd + Copy>(probabilities: &[S]) -> usize {
    (0..probabilities.len()).fold(0, |best, k| if probabilities[k] > probabilities[best] { k } else { best })
}

/// What the wheels of one instant say, sinkage left out.
fn instant(soil: &Soil<f64>, random: &mut Normal) -> [Observation<f64>; 6] {
    six_wheels(soil).each_ref().map(|wheel| {
        let mut observation = noisy(wheel, random);
        observation.state.sinkage_m = None;
        observation
    })
}

#[test]
fn six_noisy_wheels_pick_the_right_soil_of_the_bank() {
    let bank = bank();
    let mut random = Normal::new(3);
    // A soil that does not carry the rover has nothing to show.
    let carries = |soil: &Soil<f64>| sinkage_for_load(&kapvik_wheel(), soil, 0.6, EQUAL_LOAD_N).is_ok();
    assert_eq!(bank.iter().filter(|soil| !carries(soil)).count(), 1, "snow");
    for (place, truth) in bank.iter().enumerate().filter(|(_, soil)| carries(soil)) {
        for _ in 0..20 {
            let mut model = MultipleModel::<_, 8>::new(&bank).expect("room");
            let found = model.update(&kapvik_wheel(), &instant(truth, &mut random)).expect("an answer");
            assert_eq!(likeliest(model.probabilities()), place, "{:?}", model.probabilities());
            assert!(found.condition_number < 1.5, "{found:?}");
        }
    }
}

/// Bayes' rule by hand: with two soils the odds are e to the power of the difference of the logarithms, computed here for
/// noise of slip and load so small that it does not count.
#[test]
fn probabilities_are_bayes_s() {
    let [truth, other] = [soil(1.1, 15.6, 2407.4, 0.25, 31.9, 11.4), soil(1.1, 15.6, 2407.4, 0.25, 31.7, 11.4)];
    let mut observation = seen(&truth, 0.2, 65.4);
    observation.noise.slip = 1e-9;
    observation.noise.load_n = 1e-9;
    let elsewhere = seen(&other, 0.2, 65.4).state;
    let pull = (observation.state.drawbar_pull_n - elsewhere.drawbar_pull_n) / 0.5;
    let torque = (observation.state.torque_nm - elsewhere.torque_nm) / 0.05;
    let odds = (-0.5 * (pull * pull + torque * torque)).exp();
    let bank = [truth, other];
    let mut model = MultipleModel::<_, 2>::new(&bank).expect("room");
    let found = model.update(&kapvik_wheel(), &[observation]).expect("an answer");
    let expected = [1.0 / (1.0 + odds), odds / (1.0 + odds)];
    for (found, expected) in model.probabilities().iter().zip(expected) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
    let mean = expected[0] * truth.friction_angle_rad + expected[1] * other.friction_angle_rad;
    assert!((found.friction_angle_rad.value - mean).abs() < 1e-12);
    let std = (expected[0] * expected[1]).sqrt() * 0.2_f64.to_radians();
    assert!((found.friction_angle_rad.std.expect("a deviation") - std).abs() < 1e-12);
}

/// The covariance takes in the noise of slip and load, which is greater than that of the sensors of pull and torque; the
/// right soil is then turned away as rarely as said, one time in thirty thousand.
#[test]
fn slip_noise_does_not_rule_out_the_right_soil() {
    let bank = bank();
    let mut random = Normal::new(4);
    let explained = (0..500)
        .filter(|_| {
            let observed = instant(&bank[0], &mut random);
            ray(&kapvik_wheel(), &observed, &bank[..1]).expect("an answer").friction_angle_rad.identifiable
        })
        .count();
    assert_eq!(explained, 500);
}

#[test]
fn a_change_of_terrain_is_followed() {
    let bank = bank();
    let mut random = Normal::new(5);
    let mut model = MultipleModel::<_, 8>::new(&bank).expect("room");
    for place in [0, 1, 5, 0] {
        for instant_of_it in 0..50 {
            let found = model.update(&kapvik_wheel(), &instant(&bank[place], &mut random)).expect("an answer");
            if instant_of_it > 0 {
                assert_eq!(likeliest(model.probabilities()), place, "at {instant_of_it}: {:?}", model.probabilities());
                assert!((found.friction_angle_rad.value - bank[place].friction_angle_rad).abs() < 0.02);
            }
        }
    }
}

/// In single precision nothing is lost to zero or to NaN, however far off the bank's soils are.
#[test]
fn single_precision_neither_overflows_nor_vanishes() {
    let bank = bank().map(|soil| soil.map(|number| number as f32));
    let wheel = kapvik_wheel().map(|length| length as f32);
    let mut model = MultipleModel::<_, 8>::new(&bank).expect("room");
    for place in [0, 5, 1] {
        let truth = bank[place].map(f64::from);
        let observed = six_wheels(&truth).each_ref().map(|wheel| single(&averaged(wheel, 100.0)));
        let found = model.update(&wheel, &observed).expect("an answer");
        assert_eq!(likeliest(model.probabilities()), place);
        assert!((model.probabilities().iter().sum::<f32>() - 1.0).abs() < 1e-6);
        assert!((found.shear_modulus_m.value - bank[place].shear_modulus_m).abs() < 1e-4, "{found:?}");
        assert!(found.friction_angle_rad.identifiable);
    }
}

#[test]
fn a_soil_that_is_not_in_the_bank_is_not_identifiable() {
    let bank = bank();
    let observed = six_wheels(&bank[0]).each_ref().map(|wheel| averaged(wheel, 100.0));
    let found = ray(&kapvik_wheel(), &observed, &bank[1..]).expect("an answer");
    assert!(found.condition_number < 1.01, "sure of the nearest: {found:?}");
    for told in [found.cohesion_pa, found.friction_angle_rad, found.shear_modulus_m] {
        assert!(!told.identifiable);
    }
}

#[test]
fn refuses_for_a_named_reason() {
    let (wheel, observed, bank) = (kapvik_wheel(), six_wheels(&table_1_sand()), bank());
    assert_eq!(ray(&wheel, &observed, &[]).err(), Some(Refusal::NoSoilFits));
    assert_eq!(ray(&wheel, &[], &bank).err(), Some(Refusal::TooFew { needed: 1 }));
    assert_eq!(MultipleModel::<_, 3>::new(&bank).err(), Some(Refusal::TooMany { room: 3 }));
    let dust = soil(1.0, 0.0, 1.0, 0.0, 5.0, 10.0);
    assert_eq!(ray(&wheel, &observed, &[dust]).err(), Some(Refusal::NoSoilFits));
}
