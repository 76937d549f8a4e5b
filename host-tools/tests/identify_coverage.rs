//! How often the truth lies in what `identify` states, over campaigns drawn from the prior and laid out in ways that few scenes of
//! the networks' training are.

use std::fmt::Write;
use std::path::Path;

use kapvik_firmware::pipeline;
use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::wheel_state::{WheelNoise, WheelState};
use kapvik_host::data::campaign::Campaign;
use kapvik_host::identify::{Document, identify_rehearsed};
use kapvik_host::train::prior;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde_json::Value;

const TOML: &str = "\
name = \"Drawn from the prior\"
kind = \"simulated\"
source = \"equations 1–11\"
gravity_m_s2 = 9.81
[wheel]
radius_m = 0.075
width_m = 0.070
[noise]
drawbar_pull_n = 0.5
load_n = 1.0
torque_nm = 0.05
slip = 0.01
sinkage_m = 0.002
";
const NOISE: WheelNoise<f64> =
    WheelNoise { drawbar_pull_n: 0.5, load_n: 1.0, torque_nm: 0.05, slip: 0.01, sinkage_m: 0.002 };
const KEYS: [&str; 3] = ["cohesion_pa", "friction_angle_rad", "shear_modulus_m"];

/// Truly (slip, load in N) at which a wheel is driven, each in so many rows.
struct Plan {
    states: Vec<(f64, f64)>,
    rows: usize,
    /// Share of a state's noise that its next row keeps.
    kept: f64,
}

/// The noise of a state in each channel, in standard deviations.
#[derive(Clone, Default)]
struct Remembered {
    noise: [Option<f64>; 5],
    channel: usize,
}

impl Remembered {
    /// The next channel's noise, which keeps a share of what it was a row ago.
    fn next(&mut self, kept: f64, fresh: f64) -> f64 {
        let noise = &mut self.noise[self.channel % 5];
        self.channel += 1;
        *noise.insert(noise.map_or(fresh, |last| kept * last + (1.0 - kept * kept).sqrt() * fresh))
    }
}

impl Plan {
    fn of(slips: &[f64], loads_n: &[f64], rows: usize) -> Self {
        let states = slips.iter().flat_map(|slip| loads_n.iter().map(move |load_n| (*slip, *load_n)));
        Self { states: states.collect(), rows, kept: 0.0 }
    }

    /// A run on each of `soils` soils that carry the wheel, and their soils.
    fn campaign(&self, soils: usize, seed: u64) -> (String, Vec<Soil<f64>>) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut csv = "run,t_s,slip,load_n,drawbar_pull_n,torque_nm,sinkage_m\n".to_owned();
        let mut drawn = Vec::new();
        while drawn.len() < soils {
            let soil = prior::soil(prior::SOIL_RANGES.map(|range| range.at(random.random())));
            let wheel = prior::KAPVIK_WHEEL;
            let truth = |(slip, load_n): &(f64, f64)| {
                let state = WheelState::under_load(&wheel, &soil, *slip, *load_n).ok()?;
                (state.sinkage_m? <= prior::DEEPEST * wheel.radius_m).then_some(state)
            };
            let Some(truths) = self.states.iter().map(truth).collect::<Option<Vec<_>>>() else { continue };
            let mut noises = vec![Remembered::default(); truths.len()];
            for row in 0..self.rows * truths.len() {
                let (truth, noise) = (&truths[row % truths.len()], &mut noises[row % truths.len()]);
                let seen = truth.blurred(&NOISE, || noise.next(self.kept, StandardNormal.sample(&mut random)));
                let WheelState { slip, load_n, drawbar_pull_n, torque_nm, sinkage_m } = seen;
                let sinkage_m = sinkage_m.expect("simulated");
                writeln!(
                    csv,
                    "{},{row},{slip:.6},{load_n:.4},{drawbar_pull_n:.5},{torque_nm:.6},{sinkage_m:.7}",
                    drawn.len()
                )
                .expect("text");
            }
            drawn.push(soil);
        }
        (csv, drawn)
    }

    /// How many of `soils` runs have each parameter within two stated standard deviations, and within the 95 % interval; and
    /// how many runs say that they are widened.
    fn held(&self, soils: usize, seed: u64) -> ([[usize; 2]; 3], usize) {
        let (csv, drawn) = self.campaign(soils, seed);
        let campaign = Campaign::parse(Path::new("drawn.csv"), &csv, TOML).expect("a campaign");
        let found = identify_rehearsed(&campaign, &mut |query| Ok(pipeline::answer(query))).expect("identified");
        let document = serde_json::to_value(Document::of(&campaign, &found)).expect("JSON");
        let (mut held, mut widened) = ([[0; 2]; 3], 0);
        for (run, soil) in document["runs"].as_array().expect("runs").iter().zip(&drawn) {
            widened += usize::from(run["widened"].is_string());
            let truths = [soil.cohesion_pa, soil.friction_angle_rad, soil.shear_modulus_m];
            for ((held, key), truth) in held.iter_mut().zip(KEYS).zip(truths) {
                let number = |value: &Value| value.as_f64().expect("a number");
                let (value, std) = (number(&run[key]["value"]), number(&run[key]["std"]));
                let [low, high] = [0, 1].map(|end| number(&run[key]["interval_95"][end]));
                held[0] += usize::from((value - truth).abs() <= 2.0 * std);
                held[1] += usize::from((low..=high).contains(&truth));
            }
        }
        (held, widened)
    }
}

/// Of a hundred cases with a chance of 95 each, fewer than 88 are in one of 600 sets; of fifty, fewer than 42.
fn check(plan: &Plan, soils: usize, least: usize) -> usize {
    let (held, widened) = plan.held(soils, 71);
    println!("of {soils}: within 2 σ and 95 % {held:?}, widened {widened}");
    for ([_, in_interval], key) in held.into_iter().zip(KEYS) {
        assert!(in_interval >= least, "{key}: {in_interval} of {soils} in the 95 % interval");
    }
    for [within, _] in &held[1..] {
        assert!(*within >= least, "{within} of {soils} within 2 σ: {held:?}");
    }
    widened
}

#[test]
fn one_wheel_swept_over_slips_at_three_loads() {
    check(&Plan::of(&[0.05, 0.16, 0.27, 0.38, 0.49, 0.60], &[45.0, 65.0, 90.0], 30), 50, 42);
}

#[test]
fn slips_that_are_all_small() {
    check(&Plan::of(&[0.03, 0.055, 0.08, 0.105, 0.13, 0.15], &[65.0], 30), 100, 88);
}

#[test]
fn six_wheels_as_in_training_are_left_as_the_networks_state_them() {
    let widened = check(&Plan::of(&[0.05, 0.16, 0.27, 0.38, 0.49, 0.60], &[65.0], 1), 100, 88);
    assert!(widened < 30, "{widened}");
}

#[test]
fn one_wheel_at_one_slip() {
    check(&Plan::of(&[0.4], &[90.0], 30), 100, 88);
}

/// Of a hundred rows a state, whose noise keeps nine tenths from row to row, five are independent.
#[test]
fn rows_that_remember_each_other() {
    let plan = Plan::of(&[0.05, 0.16, 0.27, 0.38, 0.49, 0.60], &[45.0, 65.0, 90.0], 100);
    check(&Plan { kept: 0.9, ..plan }, 50, 42);
}
