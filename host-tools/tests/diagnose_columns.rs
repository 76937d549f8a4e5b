//! Which column a diagnosis names where what is missing follows one that is noted once a run, or that rises with the clock.

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
use diagnosis::diagnosed;

const SOIL: &str = "\
[soil]
n = { value = 1.0, std = 0.05 }
k_eff = { value = 2e6, std = 2e5 }
c = { value = 400, std = 100 }
phi = { value = 0.55, std = 0.035 }
K = { value = 0.012, std = 0.002 }
c1 = { value = 0.3, std = 0.03 }
c2 = { value = 0.15, std = 0.03 }
";
const NOISE: WheelNoise<f64> =
    WheelNoise { drawbar_pull_n: 0.4, load_n: 0.4, torque_nm: 0.03, slip: 0.002, sinkage_m: 0.0005 };

/// A row: its run, time, slip and what a further column says, and what of the soil and of the torque follows that.
struct Row {
    run: usize,
    t_s: f64,
    slip: f64,
    says: f64,
    stiffness: f64,
    beside_nm: f64,
}

fn campaign(column: &str, seed: u64, rows: impl Iterator<Item = Row>) -> Campaign {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut csv = format!("{COLUMNS},{column}\n");
    for Row { run, t_s, slip, says, stiffness, beside_nm } in rows {
        let soil: Soil<f64> = prior::soil([400.0, 0.55, 0.012, 1.0, stiffness, 0.3, 0.15]);
        let mut truth = WheelState::under_load(&prior::KAPVIK_WHEEL, &soil, slip, 65.0).expect("a soil that carries");
        truth.torque_nm += beside_nm;
        let seen = truth.blurred(&NOISE, || StandardNormal.sample(&mut random));
        writeln!(csv, "r{run},{t_s},{},{says:.3}", readings(&seen)).expect("text");
    }
    let toml = description("Columns", SOIL, Some(&NOISE));
    Campaign::parse(Path::new("columns.csv"), &csv, &toml).expect("a campaign")
}

fn told(campaign: &Campaign) -> Diagnosis {
    let document = diagnosed(campaign);
    println!("{}\n{:?}\n{:?}", document.sentence, document.unexplained, document.caveats);
    document
}

/// Runs are few and each may be off by something of its own, so that no column is beyond chance by as much as is else asked for; that
/// something is missing is, and then the column is named that follows it.
#[test]
fn a_soil_that_follows_what_is_noted_once_a_run_is_traced_to_that() {
    let moist = |seed: u64| {
        let rows = (0..32_usize).map(|row| {
            let (run, place) = (row / 4, row % 4);
            let moisture = [2.0, 4.0, 6.0, 8.0, 3.0, 5.0, 7.0, 9.0][run];
            let stiffness = 2e6 * f64::exp(-0.1 * (moisture - 5.5));
            Row {
                run,
                t_s: place as f64,
                slip: [0.1, 0.2, 0.3, 0.45][place],
                says: moisture,
                stiffness,
                beside_nm: 0.0,
            }
        });
        told(&campaign("moisture_pct", seed, rows))
    };
    let all: Vec<Diagnosis> = (1..=6).map(moist).collect();
    assert!(all.iter().all(|document| !document.sentence.contains("as well as their noise allows")));
    let traced = |document: &&Diagnosis| {
        document.verdict == Verdict::Unexplained && document.unexplained[0].regressor == "moisture_pct"
    };
    let traced = all.iter().filter(traced).count();
    assert!(traced >= 4, "{traced} of {}", all.len());
}

/// A clock does nothing to a torque, a temperature may.
#[test]
fn what_rises_with_the_clock_is_named_before_it() {
    let rows = (0..90_usize).map(|row| {
        let (run, place) = (row / 30, row % 30);
        let t_s = 10.0 * place as f64;
        let says = 12.0 + 0.05 * t_s;
        let slip = [0.1, 0.35, 0.2, 0.5, 0.05][row % 5];
        Row { run, t_s, slip, says, stiffness: 2e6, beside_nm: 0.02 * (says - 20.0) }
    });
    let document = told(&campaign("temperature_c", 5, rows));
    assert_eq!(document.verdict, Verdict::Unexplained);
    let first = &document.unexplained[0];
    assert_eq!((first.channel.as_str(), first.regressor.as_str()), ("torque_nm", "temperature_c"));
    let told = "follows in temperature_c it follows in t_s as well";
    assert!(document.caveats.iter().any(|caveat| caveat.contains(told)), "{:?}", document.caveats);
}
