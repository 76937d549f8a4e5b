//! `identify` on one run of a wheel whose slip and load are all over the place, so that its rows are averaged over different ones.

mod described;

use std::fmt::Write;
use std::path::Path;

use kapvik_firmware::pipeline;
use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::wheel_state::{WheelNoise, WheelState};
use kapvik_host::data::campaign::{Campaign, Channel};
use kapvik_host::identify::{Document, Method, NoiseSource, SensorNoise, identify_by, identify_rehearsed};
use kapvik_host::prior;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde_json::Value;

use described::{COLUMNS, description, readings};

const NOISE: WheelNoise<f64> =
    WheelNoise { drawbar_pull_n: 0.2, load_n: 0.3, torque_nm: 0.02, slip: 0.003, sinkage_m: 0.0005 };
const PHI_RAD: f64 = 0.55;

fn soil() -> Soil<f64> {
    prior::soil([800.0, PHI_RAD, 0.0114, 1.0, 1.0e6, 0.3, 0.15])
}

/// A campaign as text.
struct Sweep {
    csv: String,
    toml: String,
}

impl Sweep {
    fn campaign(&self) -> Campaign {
        Campaign::parse(Path::new("sweep.csv"), &self.csv, &self.toml).expect("a campaign")
    }
}

/// Rows at such slips and loads (N), with noise, of which what is stated is told.
fn sweep(states: &[(f64, f64)], noise: &WheelNoise<f64>, stated: Option<&WheelNoise<f64>>, seed: u64) -> Sweep {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut csv = format!("{COLUMNS}\n");
    for (row, (slip, load_n)) in states.iter().enumerate() {
        let truth = WheelState::under_load(&prior::KAPVIK_WHEEL, &soil(), *slip, *load_n).expect("a soil that carries");
        let seen = truth.blurred(noise, || StandardNormal.sample(&mut random));
        writeln!(csv, "a,{row},{}", readings(&seen)).expect("text");
    }
    Sweep { csv, toml: description("One sweep", "", stated) }
}

/// Slips from 0.03 to 0.63 and loads from 25 to 110 N, anywhere.
fn anywhere(rows: usize) -> Vec<(f64, f64)> {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    (0..rows).map(|_| (random.random_range(0.03..0.63), random.random_range(25.0..110.0))).collect()
}

/// The only run, by a method or by the networks.
fn run(campaign: &Campaign, method: Method) -> Value {
    let document = match method {
        Method::Network => {
            let found = identify_rehearsed(campaign, false, &mut |query| Ok(pipeline::answer(query)));
            Document::of(campaign, &found.expect("identified"))
        }
        _ => identify_by(method, campaign).expect("identified"),
    };
    serde_json::to_value(&document).expect("JSON")["runs"][0].clone()
}

/// Means over a curve are not on it, and their noise is small: that is no misfit of the soil, and no error of who is exact.
#[test]
fn rows_that_are_averaged_over_slips_and_loads_are_no_misfit() {
    for (rows, seed) in [(240, 2), (4000, 3), (4000, 4)] {
        let campaign = sweep(&anywhere(rows), &NOISE, Some(&NOISE), seed).campaign();
        for method in [Method::Network, Method::Map, Method::Limit] {
            let run = run(&campaign, method);
            let number = |key: &str| run["friction_angle_rad"][key].as_f64().expect("a number");
            let (value, std) = (number("value"), number("std"));
            println!("{rows} rows, {}: φ {value:.4} ± {std:.4} rad, {}", method.name(), run["misfit"]);
            assert!(run["misfit"].is_null(), "{rows} rows, {}: {}", method.name(), run["misfit"]);
            assert!((value - PHI_RAD).abs() < 3.0 * std, "{rows} rows, {}: {value} ± {std}", method.name());
            assert_eq!(run["friction_angle_rad"]["identifiable"], true);
        }
    }
}

/// Where slips are set and loads alternate, no two rows next to each other are alike, in whatever order they stand.
#[test]
fn noise_is_told_from_repeats_whatever_the_order_of_the_rows() {
    let (slips, loads_n) = ([0.1, 0.2, 0.3, 0.4, 0.5, 0.6], [45.0, 90.0]);
    let alternating: Vec<_> =
        slips.into_iter().flat_map(|slip| (0..20).map(move |row| (slip, loads_n[row % 2]))).collect();
    let loud = WheelNoise { drawbar_pull_n: 1.5, slip: 0.0, ..NOISE };
    let made = sweep(&alternating, &loud, None, 5);
    let noise = SensorNoise::of(&made.campaign()).drawbar_pull;
    assert_eq!(noise.source, NoiseSource::Repeats);
    // Sixty pairs tell it to a tenth.
    assert!((noise.std - 1.5).abs() < 0.45, "{noise:?}");
    // One number that no wheel can have felt is left out, and tells nothing of the noise either.
    let pull = made.csv.lines().nth(1).and_then(|line| line.split(',').nth(4)).expect("a pull");
    let with_gross_error = Sweep { csv: made.csv.replacen(pull, "9999", 1), toml: made.toml.clone() };
    let of_others = SensorNoise::of(&with_gross_error.campaign()).drawbar_pull;
    assert_eq!(of_others.source, NoiseSource::Repeats);
    assert!((of_others.std / noise.std - 1.0).abs() < 0.2, "{of_others:?}, {noise:?} without it");
}

/// A misfit may be the guess's where a noise is guessed.
#[test]
fn nothing_is_called_a_misfit_by_a_noise_that_nobody_states() {
    let states: Vec<_> = anywhere(24);
    let rough = WheelNoise { sinkage_m: 0.006, ..NOISE };
    let made = sweep(&states, &rough, Some(&rough), 6);
    let with = |stated: &str| Sweep { csv: made.csv.clone(), toml: made.toml.replace("sinkage_m = 0.006\n", stated) };
    let (told, untold) = (made.campaign(), with("").campaign());
    let is_stated = |campaign: &Campaign| campaign.noise.of(Channel::Sinkage).is_some();
    assert!(is_stated(&told) && !is_stated(&untold));
    for campaign in [&told, &untold] {
        assert!(run(campaign, Method::Network)["misfit"].is_null());
    }
    // Of one that is stated, and is not so, it is.
    let understated = with("sinkage_m = 0.001\n").campaign();
    assert!(run(&understated, Method::Network)["misfit"].is_string());
}
