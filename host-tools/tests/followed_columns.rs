//! Declared effects that follow a column of the campaign, in identification by the maximum a posteriori.

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
const SLIPS: [f64; 6] = [0.05, 0.12, 0.2, 0.3, 0.42, 0.55];
const DRIFT_N_PER_H: f64 = 3.0;
const PARAMETERS: [&str; 3] = ["cohesion_pa", "friction_angle_rad", "shear_modulus_m"];

/// Six slips under three loads, `repeats` times each, in one run; the drawbar pull drifts, and is read `hours` after its zero.
fn drifting(declared: &str, repeats: usize, hours: impl Fn(usize) -> Option<f64>) -> Campaign {
    let soil: Soil<f64> = prior::soil([900.0, 0.6, 0.006, 1.0, 2e6, 0.3, 0.15]);
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut csv = format!("{COLUMNS},hours_since_zero\n");
    let states = SLIPS.map(|slip| [40.0, 65.0, 95.0].map(|load_n| (slip, load_n)));
    for row in 0..repeats * states.as_flattened().len() {
        let (slip, load_n) = states.as_flattened()[row / repeats];
        let truth = WheelState::under_load(&prior::KAPVIK_WHEEL, &soil, slip, load_n).expect("a soil that carries");
        let mut seen = truth.blurred(&NOISE, || StandardNormal.sample(&mut random));
        seen.drawbar_pull_n += DRIFT_N_PER_H * hours(row).unwrap_or(2.0);
        let hours = hours(row).map_or(String::new(), |hours| hours.to_string());
        writeln!(csv, "a,{row},{},{hours}", readings(&seen)).expect("text");
    }
    let toml = description("drift", declared, Some(&NOISE));
    Campaign::parse(Path::new("drift.csv"), &csv, &toml).expect("a campaign")
}

fn mapped(campaign: &Campaign) -> Value {
    serde_json::to_value(identify_by(Method::Map, campaign).expect("identified")).expect("JSON")
}

fn number(document: &Value, parameter: &str, key: &str) -> f64 {
    document["runs"][0][parameter][key].as_f64().expect("a number")
}

const DRIFT: &str = "[declared]\neffects = [\"force-drift\"]\n[declared.force-drift]\ndrawbar_pull_n_per_h = 3.0\n";
const BIAS: &str = "[declared]\neffects = [\"force-bias\"]\n[declared.force-bias]\ndrawbar_pull_n = 6.0\n";

#[test]
fn a_drift_at_one_time_is_the_offset_that_it_has_come_to() {
    let [drift, bias] = [DRIFT, BIAS].map(|declared| mapped(&drifting(declared, 1, |_| Some(2.0))));
    for parameter in PARAMETERS {
        for key in ["value", "std"] {
            let [drift, bias] = [&drift, &bias].map(|document| number(document, parameter, key));
            assert!((drift - bias).abs() <= 1e-9 * bias.abs(), "{parameter} {key}: {drift}, as an offset {bias}");
        }
    }
    assert!(drift["runs"][0]["misfit"].is_null(), "{drift}");
}

/// 180 rows in means, each of rows at hours of its own.
#[test]
fn means_drift_as_their_rows_do() {
    let hours = |row: usize| Some(0.05 * (7 * row % 180) as f64);
    let drift = mapped(&drifting(DRIFT, 10, hours));
    assert!(drift["runs"][0]["misfit"].is_null(), "{drift}");
    for (parameter, truth) in PARAMETERS.into_iter().zip([900.0, 0.6, 0.006]) {
        let off = (number(&drift, parameter, "value") - truth) / number(&drift, parameter, "std");
        assert!(off.abs() < 3.0, "{parameter}: {off} standard deviations off");
    }
}

#[test]
fn what_follows_a_column_that_is_not_there_is_said_to_do_nothing() {
    let document = mapped(&drifting(DRIFT, 1, |_| None));
    let said = document["warnings"].to_string();
    assert!(
        said.contains("force-drift is declared and does nothing here: what it follows, hours_since_zero, no state"),
        "{said}"
    );
    let open = mapped(&drifting("[declared]\neffects = [\"force-drift\"]\n", 1, |_| Some(2.0)));
    let said = open["warnings"].to_string();
    assert!(said.contains("the form of force-drift is not declared: each run is taken to have the one"), "{said}");
}
