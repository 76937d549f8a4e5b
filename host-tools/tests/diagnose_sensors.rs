//! What a diagnosis says of errors of sensors: those of the list are named, and of others it says which channel follows its own reading.

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
const RUNS: usize = 9;
const ROWS: usize = 10;

/// Runs in which slip rises, under three loads in turn, on a soil of which nothing is missing; sensors make of a run what they do, before
/// noise.
fn diagnosed(seed: u64, read: impl Fn(&mut [WheelState<f64>])) -> Diagnosis {
    let soil: Soil<f64> = prior::soil([400.0, 0.55, 0.012, 1.0, 2e6, 0.3, 0.15]);
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut csv = format!("{COLUMNS}\n");
    for run in 0..RUNS {
        let load_n = [40.0, 65.0, 90.0][run % 3];
        let slip = |row: usize| 0.05 + 0.6 * row as f64 / (ROWS - 1) as f64;
        let state =
            |row| WheelState::under_load(&prior::KAPVIK_WHEEL, &soil, slip(row), load_n).expect("a soil that carries");
        let mut states: Vec<_> = (0..ROWS).map(state).collect();
        read(&mut states);
        for (row, state) in states.iter().enumerate() {
            let seen = state.blurred(&NOISE, || StandardNormal.sample(&mut random));
            writeln!(csv, "r{run},{row},{}", readings(&seen)).expect("text");
        }
    }
    let toml = description("sensors", "", Some(&NOISE));
    let campaign = Campaign::parse(Path::new("sensors.csv"), &csv, &toml).expect("a campaign");
    let document = diagnosis::diagnosed(&campaign);
    println!("{}\n{:?}\n{:?}", document.sentence, document.unexplained, document.caveats);
    document
}

/// The verdict is that a channel follows its own reading, and a caveat says how.
fn check_follows_itself(document: &Diagnosis, channel: &str, how: &str) {
    assert_eq!(document.verdict, Verdict::Unexplained, "{}", document.sentence);
    let first = &document.unexplained[0];
    assert_eq!((first.channel.as_str(), first.regressor.as_str()), (channel, channel));
    assert!(document.effects.is_empty() && document.ambiguous_with.is_empty());
    assert!(document.sentence.contains(&format!("{channel} against its own reading")), "{}", document.sentence);
    let says = |caveat: &String| caveat.contains(&format!("the sensor of {channel} ")) && caveat.contains(how);
    assert!(document.caveats.iter().any(says), "{:?}", document.caveats);
}

#[test]
fn friction_in_the_guide_of_a_pull_is_no_effect() {
    let held = |states: &mut [WheelState<f64>]| {
        states.iter_mut().for_each(|state| state.drawbar_pull_n -= state.drawbar_pull_n.clamp(-2.0, 2.0));
    };
    check_follows_itself(&diagnosed(1, held), "drawbar_pull_n", "a dead band, or friction, of 2.");
}

#[test]
fn a_pull_that_is_read_late_is_no_effect() {
    let late = |states: &mut [WheelState<f64>]| {
        for row in (1..states.len()).rev() {
            states[row].drawbar_pull_n = states[row - 1].drawbar_pull_n;
        }
    };
    check_follows_itself(&diagnosed(2, late), "drawbar_pull_n", "late by ");
}

#[test]
fn a_torque_sensor_that_saturates_has_no_gain() {
    let bent = |states: &mut [WheelState<f64>]| {
        states.iter_mut().for_each(|state| state.torque_nm = 4.0 * (state.torque_nm / 4.0).tanh());
    };
    check_follows_itself(&diagnosed(3, bent), "torque_nm", "bent by -0.");
}

/// The gain of a torque is an effect of the list, and stays one.
#[test]
fn a_gain_of_the_torque_is_named() {
    let gain = |states: &mut [WheelState<f64>]| states.iter_mut().for_each(|state| state.torque_nm *= 1.15);
    let document = diagnosed(4, gain);
    let ids: Vec<&str> = document.effects.iter().map(|effect| effect.id.as_str()).collect();
    assert_eq!(ids, ["torque-scale"], "{}", document.sentence);
}

#[test]
fn sensors_without_error_are_not_accused() {
    let document = diagnosed(5, |_| ());
    assert_eq!(document.verdict, Verdict::None, "{}", document.sentence);
    assert!(!document.caveats.iter().any(|caveat| caveat.contains("stands in no list")), "{:?}", document.caveats);
}
