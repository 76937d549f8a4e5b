//! Diagnosis of campaigns in which one slip was noted wrongly.

mod described;
mod diagnosis;
mod slip_sinkage;

use std::fmt::Write;
use std::path::Path;

use kapvik_firmware::wheel_state::{WheelNoise, WheelState};
use kapvik_host::data::campaign::Campaign;
use kapvik_host::diagnose::document::{Diagnosis, Verdict};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use described::{COLUMNS, description, readings};
use slip_sinkage::Sinking;

const SOIL: &str = "\
[soil]
n = { value = 1.0, std = 0.05 }
k_eff = { value = 2e6, std = 1e5 }
";
const NOISE: WheelNoise<f64> =
    WheelNoise { drawbar_pull_n: 0.5, load_n: 1.0, torque_nm: 0.04, slip: 0.004, sinkage_m: 0.0005 };
const SLIPS: [f64; 6] = [0.05, 0.15, 0.25, 0.35, 0.45, 0.55];
const LOADS_N: [f64; 4] = [40.0, 60.0, 80.0, 100.0];
/// What one row says its slip was.
const WRONG: f64 = 0.95;

/// A run of one row at each slip and load, on soil whose sinkage exponent falls by so much with slip; the slip of the run `wrong` is.
fn campaign(slip_sinkage: f64, wrong: usize, random: &mut ChaCha8Rng) -> Campaign {
    let mut csv = format!("{COLUMNS}\n");
    let soil = Sinking::drawn(slip_sinkage, random);
    for (run, (slip, load_n)) in SLIPS.into_iter().flat_map(|slip| LOADS_N.map(|load_n| (slip, load_n))).enumerate() {
        let seen = soil.seen(slip, load_n, &NOISE, random);
        let noted = if run == wrong { WheelState { slip: WRONG, ..seen } } else { seen };
        writeln!(csv, "r{run},0,{}", readings(&noted)).expect("text");
    }
    let toml = description("One wrong slip", SOIL, Some(&NOISE));
    Campaign::parse(Path::new("wrong.csv"), &csv, &toml).expect("a campaign")
}

/// Diagnoses of so many of them, the wrong run another one each time.
fn diagnosed(slip_sinkage: f64, count: usize) -> Vec<(usize, Diagnosis)> {
    let mut random = ChaCha8Rng::seed_from_u64(8);
    let one = |place: usize| {
        let wrong = 7 * place % (SLIPS.len() * LOADS_N.len());
        let campaign = campaign(slip_sinkage, wrong, &mut random);
        (wrong, diagnosis::diagnosed(&campaign))
    };
    (0..count).map(one).collect()
}

/// Where the slip truly was 0.55, its forces differ less from those at 0.95 than an effect may make them.
#[test]
fn a_clean_campaign_is_given_nothing_and_the_row_is_named() {
    let documents = diagnosed(0.0, 24);
    let given: Vec<_> = documents.iter().filter(|(_, document)| document.verdict != Verdict::None).collect();
    let is_named = |(wrong, document): &&(usize, Diagnosis)| {
        document.caveats.iter().any(|caveat| caveat.contains("Set aside") && caveat.contains(&format!("run r{wrong} ")))
    };
    let named = documents.iter().filter(is_named).count();
    println!("{} of 24 are given something; in {named} the row is named", given.len());
    assert!(given.len() <= 3, "{given:#?}");
    assert!(named >= 20, "{named} of 24");
}

#[test]
fn slip_sinkage_is_found_beside_it() {
    let documents = diagnosed(0.5, 12);
    let is_found = |(_, document): &&(usize, Diagnosis)| {
        document.effects.first().is_some_and(|effect| effect.id == "slip-sinkage")
    };
    let found = documents.iter().filter(is_found).count();
    println!("found in {found} of 12");
    assert!(found >= 10, "{found} of 12");
}
