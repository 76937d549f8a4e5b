use std::fmt::Write as _;
use std::path::Path;

use kapvik_firmware::terramechanics::effects::{Conditions, Effects, Grousers};
use kapvik_firmware::terramechanics::{Quadrature, Soil, Wheel, WheelOnSoil};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::*;
use crate::data::campaign::Campaign;
use crate::diagnose::measurements::Measurements;
use crate::diagnose::residual_search::search;
use crate::diagnose::specification::Specification;

const RADIUS_M: f64 = 0.1;
const TOML: &str = "\
name = \"Law\"
kind = \"simulated\"
source = \"equations 1 to 11\"
[wheel]
radius_m = 0.1
width_m = 0.1
[soil]
n = { value = 1.0, std = 0.05 }
k_eff = { value = 1.2e6, std = 0.1e6 }
c = { min = 0.0, max = 2000.0 }
phi = { min = 0.3, max = 0.8 }
K = { min = 0.002, max = 0.04 }
c1 = { value = 0.35, std = 0.05 }
c2 = { value = 0.2, std = 0.05 }
[noise]
slip = 0.003
load_n = 0.3
drawbar_pull_n = 0.4
torque_nm = 0.04
sinkage_m = 0.0004
";

/// A row's channels that a law may change, and what surrounds it.
struct Truth {
    torque_nm: f64,
    sinkage_m: f64,
    load_n: f64,
    slip: f64,
    temperature_c: f64,
}

/// Runs of nine rows at a slip and a load each; the temperature goes through 14 to 34 °C in each.
fn campaign(seed: u64, runs: usize, law: impl Fn(&mut Truth)) -> Campaign {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let soil = Soil {
        cohesion_pa: 700.0,
        friction_angle_rad: 0.55,
        shear_modulus_m: 0.012,
        sinkage_exponent: 1.03,
        frictional_modulus: 1.25e6,
        cohesive_modulus: 0.0,
        peak_stress_c1: 0.33,
        peak_stress_c2: 0.22,
        rebound_ratio: 0.0,
    };
    let on_soil = WheelOnSoil {
        wheel: &Wheel { radius_m: RADIUS_M, width_m: 0.1 },
        grousers: &Grousers { height_m: 0.0, count: 0.0 },
        soil: &soil,
        effects: &Effects::none(),
        gravity_m_s2: 9.81,
        quadrature: Quadrature::for_scalar::<f64>(),
    };
    let mut csv = "run,t_s,slip,load_n,drawbar_pull_n,torque_nm,sinkage_m,temperature_c,humidity\n".to_owned();
    for run in 0..runs {
        let slip = 0.05 + 0.1 * (run % 6) as f64;
        let load_n = 40.0 + 20.0 * ((run / 6) % 3) as f64;
        for row in 0..9 {
            let temperature_c = 14.0 + 2.5 * ((4 * row + run) % 9) as f64;
            let found = on_soil.at_load(&Conditions::default(), slip, load_n).expect("the soil carries it");
            let mut truth =
                Truth { torque_nm: found.torque_nm, sinkage_m: found.sinkage_m, load_n, slip, temperature_c };
            law(&mut truth);
            let mut noisy = |value: f64, std: f64| {
                let normal: f64 = StandardNormal.sample(&mut random);
                value + std * normal
            };
            let readings = [
                noisy(slip, 0.003),
                noisy(load_n, 0.3),
                noisy(found.drawbar_pull_n, 0.4),
                noisy(truth.torque_nm, 0.04),
                noisy(truth.sinkage_m, 0.0004),
                temperature_c,
            ];
            let humidity = random.random_range(30.0..60.0);
            let fields = readings.map(|reading| reading.to_string()).join(",");
            writeln!(csv, "r{run},{row},{fields},{humidity:.2}").expect("a string");
        }
    }
    Campaign::parse(Path::new("law.csv"), &csv, TOML).expect("a campaign")
}

/// The law found for a campaign where most structure is left, or for the torque's dependence on the temperature where none is.
fn found(campaign: &Campaign) -> Option<FoundLaw> {
    let measurements = Measurements::of(campaign, false).expect("measurements");
    let bench = Bench::new(campaign, &measurements);
    let trial = bench.fitted_from_many_starts(Specification::default()).expect("a fit");
    let dispersion = trial.fit.dispersion.max(1.0);
    let structure = search(&bench, &trial, dispersion).into_iter().next().expect("something was tried");
    law(&bench, &trial, &structure, dispersion)
}

#[test]
fn a_square_of_the_temperature_is_found() {
    let size = 0.03;
    let campaign = campaign(1, 33, |row| {
        row.torque_nm += size * RADIUS_M * row.load_n * ((row.temperature_c - 24.0) / 10.0).powi(2);
    });
    let law = found(&campaign).expect("a law");
    assert_eq!(law.channel, "torque_nm");
    assert!(law.formula.starts_with("torque_nm += 0.0"), "{}", law.formula);
    assert!(law.formula.contains(" r W ((temperature_c - 2"), "{}", law.formula);
    assert!(law.formula.ends_with(")/10)^2"), "one term, squared: {}", law.formula);
    assert!((law.coefficient.value - size).abs() < 4.0 * law.coefficient.std, "{:?}", law.coefficient);
    assert!(law.coefficient.std < 0.2 * size && law.gain_per_row > 0.1, "{law:?}");
}

#[test]
fn slip_times_temperature_is_found() {
    let size = -0.04;
    let campaign = campaign(2, 33, |row| {
        row.sinkage_m += size * RADIUS_M * row.slip * (row.temperature_c - 24.0) / 10.0;
    });
    let law = found(&campaign).expect("a law");
    assert_eq!(law.channel, "sinkage_m");
    let terms: Vec<&str> = law.formula.split(" r ").collect();
    assert_eq!(terms.len(), 2, "one term: {}", law.formula);
    assert!(terms[1].contains("slip ") || terms[1].ends_with(" slip"), "{}", law.formula);
    assert!(terms[1].contains("((temperature_c - 2") && !terms[1].contains(['^', '|']), "{}", law.formula);
    assert!((law.coefficient.value - size).abs() < 4.0 * law.coefficient.std, "{:?}", law.coefficient);
}

#[test]
fn nothing_is_found_in_clean_rows() {
    for seed in 3..6 {
        assert_eq!(found(&campaign(seed, 18, |_| {})), None, "seed {seed}");
    }
}
