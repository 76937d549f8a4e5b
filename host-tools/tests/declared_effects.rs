//! Effects that a campaign declares: told as fitted, doubted where the data do not show them, and in the form that leaves room for what is
//! missing. And a gauge of sinkage that was zeroed on a wheel which had sunk.

mod described;
mod diagnosis;

use std::fmt::Write;
use std::path::Path;

use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::wheel_state::{WheelNoise, WheelState};
use kapvik_host::data::campaign::Campaign;
use kapvik_host::identify::{Method, identify_by};
use kapvik_host::prior;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde_json::Value;

use described::{COLUMNS, description, readings};
use diagnosis::diagnosed;

const NOISE: WheelNoise<f64> =
    WheelNoise { drawbar_pull_n: 0.4, load_n: 1.0, torque_nm: 0.03, slip: 0.004, sinkage_m: 0.0003 };
const KNOWN: &str = "[soil]\nn = { value = 1.0, std = 0.05 }\nk_eff = { value = 2e6, std = 2e5 }\n\
                     c1 = { value = 0.3, std = 0.04 }\nc2 = { value = 0.15, std = 0.05 }\n";
const PHI_RAD: f64 = 0.6;
const SHEAR_MODULUS_M: f64 = 0.006;
const TEMPERATURE_C: f64 = 20.0;

/// What the sensors of a run add to its states, by the hours since they were zeroed.
type Wrong = fn(&mut WheelState<f64>, f64);

/// Six slips under three loads, twice each, one row a run, over a day; with effects that are declared.
fn campaign(declared: &str, seed: u64, wrong: Wrong) -> Campaign {
    let soil: Soil<f64> = prior::soil([900.0, PHI_RAD, SHEAR_MODULUS_M, 1.0, 2e6, 0.3, 0.15]);
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut csv = format!("{COLUMNS},hours_since_zero,temperature_c\n");
    let states = [0.05, 0.12, 0.2, 0.3, 0.42, 0.55].map(|slip| [40.0, 65.0, 95.0].map(|load_n| [(slip, load_n); 2]));
    for (run, (slip, load_n)) in states.as_flattened().as_flattened().iter().enumerate() {
        let truth = WheelState::under_load(&prior::KAPVIK_WHEEL, &soil, *slip, *load_n).expect("a soil that carries");
        let mut seen = truth.blurred(&NOISE, || StandardNormal.sample(&mut random));
        let [hours, temperature_c] = [random.random_range(0.0..8.0), TEMPERATURE_C + random.random_range(-3.0..3.0)];
        wrong(&mut seen, hours);
        writeln!(csv, "r{run},0,{},{hours:.3},{temperature_c:.2}", readings(&seen)).expect("text");
    }
    let tables = format!("{KNOWN}[declared]\neffects = [{declared}]\n");
    Campaign::parse(Path::new("day.csv"), &csv, &description("A day", &tables, Some(&NOISE))).expect("a campaign")
}

/// The same in one run, as identification takes wheels of one soil.
fn in_one_run(campaign: &Campaign) -> Campaign {
    let mut csv = format!("{COLUMNS}\n");
    for row in 0..campaign.rows().len() {
        let value = |name: &str| campaign.column(name).expect("a column")[row].expect("measured");
        let names =
            ["slip", "load_n", "drawbar_pull_n", "torque_nm", "sinkage_m"].map(value).map(|value| value.to_string());
        writeln!(csv, "a,{row},{}", names.join(",")).expect("text");
    }
    let ids: Vec<String> = campaign.declared.ids().iter().map(|id| format!("\"{id}\"")).collect();
    let tables = format!("{KNOWN}[declared]\neffects = [{}]\n", ids.join(", "));
    Campaign::parse(Path::new("run.csv"), &csv, &description("A run", &tables, Some(&NOISE))).expect("a campaign")
}

fn mapped(campaign: &Campaign) -> Value {
    let document = identify_by(Method::Map, campaign).expect("identified");
    serde_json::to_value(&document).expect("JSON")["runs"][0].clone()
}

/// A hump at twice the shear modulus is nearly the law without one.
#[test]
fn a_hump_that_is_declared_and_not_there_is_doubted() {
    for seed in 1..4 {
        let campaign = campaign("\"shear-hump\"", seed, |_, _| ());
        let found = diagnosed(&campaign);
        assert!(found.effects.is_empty(), "{}", found.sentence);
        assert_eq!(found.declared_effects[0].id, "shear-hump");
        assert!(!found.declared_effects[0].parameters.is_empty());
        let doubt = "The data do not show shear-hump, which is declared";
        assert!(found.caveats.iter().any(|said| said.starts_with(doubt)), "{:?}", found.caveats);
        let run = mapped(&in_one_run(&campaign));
        let modulus = &run["shear_modulus_m"];
        let off = (modulus["value"].as_f64().expect("K") - SHEAR_MODULUS_M) / modulus["std"].as_f64().expect("std");
        assert!(off.abs() < 3.0 || modulus["identifiable"] == false, "{modulus}");
    }
}

/// A drift with temperature whose zero is free is an offset, too; one with hours leaves that to be found.
#[test]
fn a_declared_drift_does_not_hide_an_offset() {
    for seed in 1..4 {
        let found = diagnosed(&campaign("\"force-drift\"", seed, |seen, hours| {
            seen.drawbar_pull_n += 0.5 * hours - 5.0;
        }));
        let [offset] = found.effects.as_slice() else { panic!("{}", found.sentence) };
        assert_eq!(offset.id, "force-bias");
        let drift = &found.declared_effects[0];
        assert_eq!(drift.form, "drawbar pull with hours");
        let rate = &drift.parameters["drawbar_pull_n_per_h"];
        assert!((rate.value - 0.5).abs() < 3.0 * rate.std, "{rate:?}");
    }
}

/// An offset of the load, where the first form of what is declared is one of the drawbar pull.
#[test]
fn map_takes_the_form_that_explains_the_wheels() {
    for seed in 1..4 {
        let campaign = in_one_run(&campaign("\"force-bias\"", seed, |seen, _| seen.load_n += 9.0));
        let run = mapped(&campaign);
        assert!(run["misfit"].is_null(), "{run}");
        let angle = &run["friction_angle_rad"];
        let off = (angle["value"].as_f64().expect("φ") - PHI_RAD) / angle["std"].as_f64().expect("std");
        assert!(off.abs() < 3.5, "{angle}");
    }
}

/// Readings from some millimetres below zero on: less than what is missing.
#[test]
fn a_gauge_that_was_zeroed_on_a_sunk_wheel_is_found() {
    for seed in 1..4 {
        let found = diagnosed(&campaign("", seed, |seen, _| {
            seen.sinkage_m = seen.sinkage_m.map(|sinkage_m| sinkage_m - 0.011);
        }));
        let first = found.effects.first().unwrap_or_else(|| panic!("{}", found.sentence));
        assert_eq!(first.id, "sinkage-reference", "{}", found.sentence);
        assert!((first.parameters["offset_m"].value + 0.011).abs() < 0.001, "{first:?}");
    }
}
