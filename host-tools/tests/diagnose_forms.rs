//! Diagnosis of laws that come in more than one form.

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
n = { value = 1.05, std = 0.05 }
k_eff = { value = 2.7e6, std = 3e5 }
c = { value = 220, std = 100 }
phi = { value = 0.56, std = 0.04 }
K = { value = 0.0105, std = 0.0017 }
c1 = { value = 0.18, std = 0.02 }
c2 = { value = 0.32, std = 0.02 }
";
const NOISE: WheelNoise<f64> =
    WheelNoise { drawbar_pull_n: 0.7, load_n: 0.5, torque_nm: 0.07, slip: 0.003, sinkage_m: 0.0004 };
const LOADS_N: [f64; 3] = [40.0, 65.0, 98.0];
const SLIPS: usize = 14;

/// What is diagnosed where a wheel on a soil does so at a slip and under a load, each its own run.
fn diagnosed(seed: u64, law: fn(&Soil<f64>, f64, f64) -> WheelState<f64>) -> Diagnosis {
    let soil: Soil<f64> = prior::soil([220.0, 0.57, 0.0104, 1.05, 2.77e6, 0.18, 0.32]);
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut csv = format!("{COLUMNS}\n");
    for (place, load_n) in LOADS_N.into_iter().flat_map(|load_n| (0..SLIPS).map(move |place| (place, load_n))) {
        let slip = 0.02 + 0.6 * place as f64 / (SLIPS - 1) as f64;
        let seen = law(&soil, slip, load_n).blurred(&NOISE, || StandardNormal.sample(&mut random));
        writeln!(csv, "{load_n} N {place},0,{}", readings(&seen)).expect("text");
    }
    let toml = description("Slips under three loads", SOIL, Some(&NOISE));
    let campaign = Campaign::parse(Path::new("forms.csv"), &csv, &toml).expect("a campaign");
    let document = diagnosis::diagnosed(&campaign);
    println!("{}\n{:?}", document.sentence, document.effects);
    document
}

fn under_load(soil: &Soil<f64>, slip: f64, load_n: f64) -> WheelState<f64> {
    WheelState::under_load(&prior::KAPVIK_WHEEL, soil, slip, load_n).expect("a soil that carries")
}

/// Which form fits best alone says little: beside an offset of the pull the exponent is the law, and without it another form is.
#[test]
fn the_form_of_an_effect_is_chosen_beside_its_companion() {
    let law = |soil: &Soil<f64>, slip: f64, load_n: f64| {
        let state = under_load(&Soil { sinkage_exponent: soil.sinkage_exponent + 0.35 * slip, ..*soil }, slip, load_n);
        WheelState { drawbar_pull_n: state.drawbar_pull_n + 3.8, ..state }
    };
    for seed in 1..=4 {
        let document = diagnosed(seed, law);
        let mut found: Vec<_> =
            document.effects.iter().map(|effect| [effect.id.as_str(), effect.form.as_str()]).collect();
        found.sort_unstable();
        assert_eq!(found, [["force-bias", "drawbar pull"], ["slip-sinkage", "exponent"]], "seed {seed}");
    }
}

/// Sinkage that is read as (1 + i)/(1 − i/2) times what carries the load is one effect, not the first of several.
#[test]
fn a_sinkage_by_the_law_of_lyasko_is_one_effect() {
    let law = |soil: &Soil<f64>, slip: f64, load_n: f64| {
        let state = under_load(soil, slip, load_n);
        WheelState {
            sinkage_m: state.sinkage_m.map(|sinkage_m| sinkage_m * (1.0 + slip) / (1.0 - 0.5 * slip)),
            ..state
        }
    };
    for seed in 1..=3 {
        let document = diagnosed(seed, law);
        let found: Vec<_> = document.effects.iter().map(|effect| effect.id.as_str()).collect();
        assert_eq!((document.verdict, found), (Verdict::Effect, vec!["slip-sinkage"]), "seed {seed}");
    }
}
