//! What a diagnosis says where it is the description of a campaign that is at fault: noise of slip that nobody states, a soil that is stated
//! wrong, a sensor at the end of its range.

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

const NOISE: WheelNoise<f64> =
    WheelNoise { drawbar_pull_n: 0.5, load_n: 0.3, torque_nm: 0.04, slip: 0.002, sinkage_m: 0.0004 };

/// Runs of some rows in which slip rises, under three loads in turn, on a soil of which nothing is missing; what is seen is changed, and some
/// tables describe it.
fn diagnosed(
    [runs, rows]: [usize; 2],
    noise: &WheelNoise<f64>,
    changed: impl Fn(WheelState<f64>) -> WheelState<f64>,
    tables: &str,
) -> Diagnosis {
    let soil: Soil<f64> = prior::soil([400.0, 0.55, 0.012, 1.0, 2e6, 0.3, 0.15]);
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let mut csv = format!("{COLUMNS}\n");
    for run in 0..runs {
        for row in 0..rows {
            let slip = 0.05 + 0.6 * row as f64 / (rows - 1) as f64;
            let load_n = [40.0, 65.0, 90.0][run % 3];
            let truth = WheelState::under_load(&prior::KAPVIK_WHEEL, &soil, slip, load_n).expect("a soil that carries");
            let seen = changed(truth.blurred(noise, || StandardNormal.sample(&mut random)));
            writeln!(csv, "r{run},{row},{}", readings(&seen)).expect("text");
        }
    }
    let toml = description("doubts", tables, None);
    let campaign = Campaign::parse(Path::new("doubts.csv"), &csv, &toml).expect("a campaign");
    let document = diagnosis::diagnosed(&campaign);
    println!("{}\n{:?}\n{:?}", document.sentence, document.unexplained, document.caveats);
    document
}

fn says(document: &Diagnosis, words: &str) -> bool {
    document.caveats.iter().any(|caveat| caveat.contains(words))
}

/// A clock tells where a sweep is better than slips do that scatter about it.
#[test]
fn slips_that_scatter_about_a_sweep_make_nothing_follow_the_clock() {
    let document = diagnosed([6, 40], &WheelNoise { slip: 0.02, ..NOISE }, |seen| seen, "");
    assert_eq!(document.verdict, Verdict::None, "{}", document.sentence);
    assert!(says(&document, "state [noise] slip"));
}

#[test]
fn a_modulus_that_is_stated_wrong_is_named_beside_the_effect_that_it_looks_like() {
    let stated = |modulus_m: f64| {
        format!(
            "[soil]\nn = 1.0\nk_eff = 2e6\nc = 400.0\nphi = 0.55\nK = {modulus_m}\nc1 = 0.3\nc2 = 0.15\n[noise]\n\
             drawbar_pull_n = 0.5\nload_n = 0.3\ntorque_nm = 0.04\nslip = 0.002\nsinkage_m = 0.0004\n"
        )
    };
    let wrong = diagnosed([6, 12], &NOISE, |seen| seen, &stated(0.015));
    assert!(!wrong.effects.is_empty(), "{}", wrong.sentence);
    assert!(says(&wrong, "K in [soil] may be wrong instead: the data alone say 0.01"), "{:?}", wrong.caveats);
    let right = diagnosed([6, 12], &NOISE, |seen| seen, &stated(0.012));
    assert!(right.effects.is_empty() && !says(&right, "in [soil]"), "{}", right.sentence);
}

/// What a sensor reads at the end of its range is not what the wheel felt, and no law is lacking.
#[test]
fn a_torque_that_stays_at_its_greatest_is_no_effect() {
    let at_most = |seen: WheelState<f64>| WheelState { torque_nm: seen.torque_nm.min(2.0), ..seen };
    let document = diagnosed([6, 20], &NOISE, at_most, "");
    assert_eq!(document.verdict, Verdict::None, "{}", document.sentence);
    assert!(says(&document, "torque_nm reads exactly 2 in"));
}
