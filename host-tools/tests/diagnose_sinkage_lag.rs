//! Diagnosis of wheels that sink over a way from half of their sinkage on, as their runs begin.

mod described;
mod diagnosis;
mod slip_sinkage;

use std::fmt::Write;
use std::path::Path;

use kapvik_firmware::wheel_state::{WheelNoise, WheelState};
use kapvik_host::data::campaign::Campaign;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use described::{COLUMNS, description, readings};
use diagnosis::diagnosed;
use slip_sinkage::Sinking;

const SOIL: &str = "\
[soil]
n = { value = 1.0, std = 0.05 }
k_eff = { value = 2e6, std = 2e5 }
c1 = { value = 0.3, std = 0.04 }
c2 = { value = 0.15, std = 0.05 }
";
const NOISE: WheelNoise<f64> =
    WheelNoise { drawbar_pull_n: 0.9, load_n: 0.7, torque_nm: 0.05, slip: 0.004, sinkage_m: 0.0004 };
/// Each run's.
const SLIPS: [f64; 6] = [0.08, 0.2, 0.3, 0.42, 0.5, 0.57];
const LOADS_N: [f64; 6] = [45.0, 98.0, 65.0, 45.0, 98.0, 65.0];
const ROWS: usize = 24;
/// Way between rows, m.
const STEP_M: f64 = 0.03;
const START: f64 = 0.5;

/// z = z∞ (1 − (1 − start) e^(−x/L)) along each run.
fn campaign(length_m: f64, random: &mut ChaCha8Rng) -> Campaign {
    let soil = Sinking::drawn(0.0, random);
    let mut csv = format!("{COLUMNS},travel_m\n");
    for (run, (slip, load_n)) in SLIPS.into_iter().zip(LOADS_N).enumerate() {
        let settled_m = soil.truth(slip, load_n).sinkage_m.expect("simulated");
        for row in 0..ROWS {
            let travel_m = STEP_M * (row as f64 + 0.5);
            let lacking_m = (1.0 - START) * libm::exp(-travel_m / length_m) * settled_m;
            let read = soil.seen(slip, load_n, &NOISE, random);
            let seen = WheelState { sinkage_m: read.sinkage_m.map(|read_m| read_m - lacking_m), ..read };
            writeln!(csv, "r{run},{row},{},{travel_m:.4}", readings(&seen)).expect("text");
        }
    }
    Campaign::parse(Path::new("lag.csv"), &csv, &description("Sinking", SOIL, Some(&NOISE))).expect("a campaign")
}

/// Runs are off by much where they begin, and that may neither pass for gross errors, nor for the zero of a sensor in each run.
#[test]
fn way_and_share_of_a_lag_are_found() {
    for (seed, length_m) in [0.03, 0.05, 0.075, 0.1, 0.15, 0.2].into_iter().enumerate() {
        let campaign = campaign(length_m, &mut ChaCha8Rng::seed_from_u64(seed as u64));
        let document = diagnosed(&campaign);
        println!("L = {length_m} m: {}", document.sentence);
        assert_eq!(document.effects.first().map(|effect| effect.id.as_str()), Some("sinkage-lag"));
        let found = &document.effects[0].parameters;
        println!("{found:?}");
        assert!((found["length_m"].value / length_m - 1.0).abs() < 0.3, "{length_m}: {found:?}");
        assert!((found["start"].value - START).abs() < 0.1, "{found:?}");
    }
}
