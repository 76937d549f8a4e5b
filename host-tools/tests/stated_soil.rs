//! What a campaign states of its soil, and what identification by the maximum a posteriori makes of that.

mod described;

use std::fmt::Write;
use std::path::Path;

use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::wheel_state::{WheelNoise, WheelState};
use kapvik_host::data::campaign::Campaign;
use kapvik_host::identify::{Method, identify_by};
use kapvik_host::prior;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde_json::Value;

use described::{COLUMNS, description, readings};

const NOISE: WheelNoise<f64> =
    WheelNoise { drawbar_pull_n: 0.4, load_n: 1.0, torque_nm: 0.03, slip: 0.004, sinkage_m: 0.0003 };
const PARAMETERS: [&str; 3] = ["cohesion_pa", "friction_angle_rad", "shear_modulus_m"];

fn truths(soil: &Soil<f64>) -> [f64; 3] {
    [soil.cohesion_pa, soil.friction_angle_rad, soil.shear_modulus_m]
}

/// Six slips under three loads on a soil, in one run, identified with what is stated of it.
fn mapped(soil: &Soil<f64>, stated: &str, seed: u64) -> Value {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut csv = format!("{COLUMNS}\n");
    let states = [0.05, 0.12, 0.2, 0.3, 0.42, 0.55].map(|slip| [40.0, 65.0, 95.0].map(|load_n| (slip, load_n)));
    for (row, (slip, load_n)) in states.as_flattened().iter().enumerate() {
        let truth = WheelState::under_load(&prior::KAPVIK_WHEEL, soil, *slip, *load_n).expect("a soil that carries");
        let seen = truth.blurred(&NOISE, || StandardNormal.sample(&mut random));
        writeln!(csv, "a,{row},{}", readings(&seen)).expect("text");
    }
    let toml = description("stated", &format!("[soil]\n{stated}\n"), Some(&NOISE));
    let campaign = Campaign::parse(Path::new("stated.csv"), &csv, &toml).expect("a campaign");
    serde_json::to_value(identify_by(Method::Map, &campaign).expect("identified")).expect("JSON")["runs"][0].clone()
}

/// Sum of the squared errors of c, φ and K over their stated standard deviations.
fn normalised_square(run: &Value, soil: &Soil<f64>) -> f64 {
    let squares = PARAMETERS.into_iter().zip(truths(soil)).map(|(name, truth)| {
        let number = |key: &str| run[name][key].as_f64().expect("a number");
        ((number("value") - truth) / number("std")).powi(2)
    });
    squares.sum()
}

#[test]
fn a_cohesion_that_is_stated_to_be_next_to_nothing_is_not_overridden_in_silence() {
    let soil = prior::soil([4000.0, 0.55, 0.012, 1.0, 2e6, 0.3, 0.15]);
    let run = mapped(&soil, "c = { value = 0.0, std = 100.0 }", 1);
    assert!(run["cohesion_pa"]["value"].as_f64().expect("c") <= 620.0, "{run}");
    assert!(run["misfit"].is_string(), "{run}");
    assert!(PARAMETERS.iter().all(|name| run[name]["identifiable"] == false), "{run}");
}

/// A pressure of 20 kPa at 15 mm, which is what is believed of it. χ² of three numbers is above 16.3 in one of a thousand cases.
#[test]
fn a_true_exponent_that_is_stated_does_no_harm() {
    for exponent in [0.7_f64, 1.4] {
        let soil = prior::soil([900.0, 0.6, 0.01, exponent, 20e3 / 0.015_f64.powf(exponent), 0.3, 0.15]);
        let mut stated = 0.0;
        for seed in 1..5 {
            let run = mapped(&soil, &format!("n = {exponent}"), seed);
            assert!(run["misfit"].is_null(), "{run}");
            stated += normalised_square(&run, &soil);
        }
        assert!(stated < 32.9, "χ² of twelve numbers at n = {exponent}: {stated}");
    }
}

/// 0.25, which is stated to be within 0 … 0.5, or 0.15 ± 0.1.
#[test]
fn a_rebound_that_is_not_known_exactly_is_fitted() {
    let soil = Soil { rebound_ratio: 0.25, ..prior::soil([900.0, 0.6, 0.01, 1.0, 2e6, 0.3, 0.15]) };
    for stated in ["eta = { min = 0.0, max = 0.5 }", "eta = { value = 0.15, std = 0.1 }"] {
        let mut square = 0.0;
        for seed in 1..5 {
            let run = mapped(&soil, stated, seed);
            assert!(run["misfit"].is_null(), "{stated}: {run}");
            square += normalised_square(&run, &soil);
        }
        assert!(square < 32.9, "χ² of twelve numbers where {stated}: {square}");
    }
}
