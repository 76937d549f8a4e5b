//! Diagnosis of few runs along which the slip rises, with noise of which a row keeps a share of the row before.

mod described;
mod diagnosis;

use std::fmt::Write;
use std::path::Path;

use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::wheel_state::{WheelNoise, WheelState};
use kapvik_host::data::campaign::Campaign;
use kapvik_host::diagnose::document::{Diagnosis, Verdict};
use kapvik_host::prior;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use described::{COLUMNS, description, readings};

const SOIL: &str = "\
[soil]
n = { value = 1.0, std = 0.05 }
k_eff = { value = 2e6, std = 1e5 }
";
const NOISE: WheelNoise<f64> =
    WheelNoise { drawbar_pull_n: 0.8, load_n: 0.7, torque_nm: 0.06, slip: 0.004, sinkage_m: 0.0009 };
const LOADS_N: [f64; 4] = [40.0, 65.0, 98.0, 65.0];
const ROWS: usize = 40;

/// What a wheel does on a soil at a slip and under a load.
type Law = fn(&Soil<f64>, f64, f64) -> WheelState<f64>;

fn declared(soil: &Soil<f64>, slip: f64, load_n: f64) -> WheelState<f64> {
    WheelState::under_load(&prior::KAPVIK_WHEEL, soil, slip, load_n).expect("a soil that carries")
}

/// A run at each load.
fn campaign(kept: f64, law: Law) -> Campaign {
    let soil: Soil<f64> = prior::soil([400.0, 0.55, 0.012, 1.0, 2e6, 0.3, 0.15]);
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let mut csv = format!("{COLUMNS}\n");
    for (run, load_n) in LOADS_N.into_iter().enumerate() {
        let mut noise: [f64; 5] = std::array::from_fn(|_| StandardNormal.sample(&mut random));
        for row in 0..ROWS {
            let slip = 0.02 + 0.6 * row as f64 / (ROWS - 1) as f64;
            for noise in &mut noise {
                let fresh: f64 = StandardNormal.sample(&mut random);
                *noise = kept * *noise + (1.0 - kept * kept).sqrt() * fresh;
            }
            let mut noise = noise.into_iter().cycle();
            let seen = law(&soil, slip, load_n).blurred(&NOISE, || noise.next().unwrap_or_default());
            writeln!(csv, "r{run},{},{}", 2 * row, readings(&seen)).expect("text");
        }
    }
    let toml = description("Slip that rises", SOIL, Some(&NOISE));
    Campaign::parse(Path::new("rising.csv"), &csv, &toml).expect("a campaign")
}

fn diagnosed(kept: f64, law: Law) -> Diagnosis {
    let document = diagnosis::diagnosed(&campaign(kept, law));
    println!("{}\n{:?}\n{:?}", document.sentence, document.unexplained, document.caveats);
    document
}

/// Some forty independent readings of 160 rows, in four runs.
#[test]
fn an_effect_is_named_in_four_runs_though_noise_remembers() {
    let sinks = |soil: &Soil<f64>, slip: f64, load_n: f64| {
        declared(&Soil { sinkage_exponent: soil.sinkage_exponent - 0.3 * slip, ..*soil }, slip, load_n)
    };
    let document = diagnosed(0.6, sinks);
    assert_eq!(
        document.effects.first().map(|effect| effect.id.as_str()),
        Some("slip-sinkage"),
        "{}",
        document.sentence
    );
}

#[test]
fn noise_that_remembers_is_no_effect() {
    for kept in [0.3, 0.6, 0.85] {
        assert_eq!(diagnosed(kept, declared).verdict, Verdict::None);
    }
}

/// Two waves over the slips, which no curve that turns at most twice follows.
#[test]
fn a_law_that_no_column_tells_leaves_structure_along_runs() {
    let wave = |soil: &Soil<f64>, slip: f64, load_n: f64| {
        let state = declared(soil, slip, load_n);
        WheelState { torque_nm: state.torque_nm + 0.4 * libm::sin(std::f64::consts::TAU * slip / 0.3), ..state }
    };
    let document = diagnosed(0.0, wave);
    assert_eq!(document.verdict, Verdict::Unexplained, "{}", document.sentence);
    assert_eq!(document.unexplained.first().map(|left| left.channel.as_str()), Some("torque_nm"));
}
