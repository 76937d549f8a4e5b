//! Diagnosis of five runs of twelve rows each, with noise that is stated: what of them is left, and what is said of it.

mod described;
mod diagnosis;

use std::fmt::Write;
use std::path::Path;

use kapvik_firmware::pipeline;
use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::wheel_state::{WheelNoise, WheelState};
use kapvik_host::data::campaign::{Campaign, Declared, Knowledge};
use kapvik_host::diagnose::declared_file;
use kapvik_host::diagnose::document::{Diagnosis, Verdict};
use kapvik_host::identify::{Document, identify_rehearsed};
use kapvik_host::prior;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use described::{COLUMNS, description, readings};

const SOIL: &str = "\
[soil]
n = { value = 1.0, std = 0.05 }
k_eff = { value = 2e6, std = 1e5 }
c1 = { value = 0.3, std = 0.03 }
c2 = { value = 0.15, std = 0.03 }
";
const NOISE: WheelNoise<f64> =
    WheelNoise { drawbar_pull_n: 0.4, load_n: 0.4, torque_nm: 0.03, slip: 0.002, sinkage_m: 0.0005 };
const RUNS: usize = 5;
const ROWS: usize = 12;

/// What a sensor of the torque reads beside it, N·m, at a temperature, °C.
type Reads = fn(f64) -> f64;
/// The exponent and the stiffness of the soil at a slip and under a load, N.
type Ground = fn(f64, f64) -> (f64, f64);

/// Five runs whose noise is so many times what is stated, and tables of TOML besides.
fn campaign(ground: Ground, reads: Reads, times_noise: f64, tables: &str) -> Campaign {
    campaign_of(&NOISE, ground, reads, times_noise, tables)
}

/// The same with another noise that is stated.
fn campaign_of(stated: &WheelNoise<f64>, ground: Ground, reads: Reads, times_noise: f64, tables: &str) -> Campaign {
    let mut random = ChaCha8Rng::seed_from_u64(23);
    let mut csv = format!("{COLUMNS},temperature_c\n");
    for (run, row) in (0..RUNS).flat_map(|run| (0..ROWS).map(move |row| (run, row))) {
        let slip = 0.05 + 0.5 * row as f64 / (ROWS - 1) as f64;
        let load_n = [45.0, 65.0, 95.0][random.random_range(0..3)];
        let temperature_c = 10.0 + 3.0 * run as f64 + random.random_range(0.0..15.0);
        let (exponent, stiffness) = ground(slip, load_n);
        let soil: Soil<f64> = prior::soil([400.0, 0.55, 0.012, exponent, stiffness, 0.3, 0.15]);
        let mut truth = WheelState::under_load(&prior::KAPVIK_WHEEL, &soil, slip, load_n).expect("a soil that carries");
        truth.torque_nm += reads(temperature_c);
        let noise = stated.map(|std| times_noise * std);
        let seen = truth.blurred(&noise, || StandardNormal.sample(&mut random));
        writeln!(csv, "r{run},{},{},{temperature_c:.3}", 5 * row, readings(&seen)).expect("text");
    }
    let toml = description("Five runs", &format!("{SOIL}{tables}"), Some(stated));
    Campaign::parse(Path::new("five.csv"), &csv, &toml).expect("a campaign")
}

fn as_declared(_: f64, _: f64) -> (f64, f64) {
    (1.0, 2e6)
}

fn diagnosed(campaign: &Campaign) -> Diagnosis {
    let document = diagnosis::diagnosed(campaign);
    println!("{}\n{:?}\n{:?}", document.sentence, document.unexplained, document.effects);
    document
}

/// Rows tell it, of which there are sixty; that there are five runs does not matter, since these are off by nothing of their own.
#[test]
fn what_follows_a_column_shows_in_few_runs() {
    let document = diagnosed(&campaign(as_declared, |temperature_c| 0.01 * (temperature_c - 20.0), 1.0, ""));
    assert_eq!(document.verdict, Verdict::Unexplained);
    let first = &document.unexplained[0];
    assert_eq!((first.channel.as_str(), first.regressor.as_str()), ("torque_nm", "temperature_c"));
}

/// Noise that is stated too small is no law, and still it is said that the model misses the data.
#[test]
fn noise_that_is_stated_too_small_is_told() {
    let document = diagnosed(&campaign(as_declared, |_| 0.0, 4.0, ""));
    assert_eq!(document.verdict, Verdict::None);
    assert!(document.sentence.contains("times its stated noise"), "{}", document.sentence);
    let clean = diagnosed(&campaign(as_declared, |_| 0.0, 1.0, ""));
    assert!(clean.verdict == Verdict::None && clean.sentence.contains("as well as their noise allows"));
}

/// It moves the drawbar pull by three times the pull's own noise.
#[test]
fn a_slip_that_is_as_noisy_as_it_is_stated_is_no_misfit() {
    let noisy = WheelNoise { slip: 0.03, ..NOISE };
    let document = diagnosed(&campaign_of(&noisy, as_declared, |_| 0.0, 1.0, ""));
    let pull = document.channels["drawbar_pull_n"];
    assert!(pull.rmse_after.is_some_and(|error| error > 2.0 * pull.noise), "{pull:?}");
    assert!(document.sentence.contains("as well as their noise allows"), "{}", document.sentence);
}

/// A soil that is stiffer under more load: how much by means nothing without the load at which it is what `soil_after` says.
#[test]
fn what_an_effect_refers_to_is_told_and_declared() {
    let stiffens = |_: f64, load_n: f64| (1.0, 2e6 * (load_n / 65.0).powf(0.5));
    let campaign = campaign(stiffens, |_| 0.0, 1.0, "");
    let document = diagnosed(&campaign);
    let effect = document.effects.iter().find(|effect| effect.id == "load-stiffening").expect("found");
    let reference = effect.parameters["reference_load_n"];
    assert!(reference.std == 0.0 && (45.0..95.0).contains(&reference.value), "{reference:?}");
    let declared = Declared::parse(Path::new("d.toml"), &declared_file(&campaign, &document)).expect("a declaration");
    let known = declared.effects.iter().find(|effect| effect.info.id == "load-stiffening").expect("declared");
    assert_eq!(known.known.get("reference_load_n"), Some(&Knowledge::Value { value: reference.value, std: 0.0 }));
}

/// Networks that know no effects are as wrong where one is declared as where none is: nothing of it is called identifiable.
#[test]
fn what_a_campaign_declares_is_nothing_to_networks_that_do_not_know_it() {
    let sinks = |slip: f64, _: f64| (1.0 - 0.4 * slip, 2e6);
    for declared in ["", "[declared]\neffects = [\"slip-sinkage\"]\n[declared.slip-sinkage]\nn1 = -0.4\n"] {
        let campaign = campaign(sinks, |_| 0.0, 1.0, declared);
        let found = identify_rehearsed(&campaign, false, &mut |query| Ok(pipeline::answer(query))).expect("identified");
        assert!(found.runs.iter().all(|run| run.misfit.is_some()), "no soil explains any run");
        let document = serde_json::to_value(Document::of(&campaign, &found)).expect("a document is JSON");
        for run in document["runs"].as_array().expect("runs") {
            for parameter in ["cohesion_pa", "friction_angle_rad", "shear_modulus_m"] {
                assert_eq!(run[parameter]["identifiable"], false, "{parameter} of {run}");
            }
        }
    }
}
