//! Campaigns drawn from the prior, and how often the truth lies in what is stated of them.

#[path = "../columns/without.rs"]
mod without;

use std::fmt::Write;
use std::path::Path;

use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::wheel_state::WheelState;
use kapvik_host::data::campaign::Campaign;
use kapvik_host::identify::Document;
use kapvik_host::prior;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde_json::Value;

use self::without::without;
use crate::described::{COLUMNS, description, readings};

/// Parameters in the document.
pub const KEYS: [&str; 3] = ["cohesion_pa", "friction_angle_rad", "shear_modulus_m"];

/// Truly (slip, load in N) at which a wheel is driven, each in so many rows.
pub struct Plan {
    /// Slips and loads.
    pub states: Vec<(f64, f64)>,
    /// Rows of each.
    pub rows: usize,
    /// Share of a state's noise that its next row keeps.
    pub kept: f64,
    /// Columns that are not measured.
    pub lacking: &'static [&'static str],
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
    /// Each slip at each load.
    pub fn of(slips: &[f64], loads_n: &[f64], rows: usize) -> Self {
        let states = slips.iter().flat_map(|slip| loads_n.iter().map(move |load_n| (*slip, *load_n)));
        Self { states: states.collect(), rows, kept: 0.0, lacking: &[] }
    }

    /// A run on each of `soils` soils that carry the wheel, and their soils.
    pub fn campaign(&self, soils: usize, seed: u64) -> (Campaign, Vec<Soil<f64>>) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut csv = format!("{COLUMNS}\n");
        let mut drawn = Vec::new();
        while drawn.len() < soils {
            let soil = prior::any_soil(|| random.random());
            let wheel = prior::KAPVIK_WHEEL;
            let truth = |(slip, load_n): &(f64, f64)| {
                let state = WheelState::under_load(&wheel, &soil, *slip, *load_n).ok()?;
                (state.sinkage_m? <= prior::DEEPEST * wheel.radius_m).then_some(state)
            };
            let Some(truths) = self.states.iter().map(truth).collect::<Option<Vec<_>>>() else { continue };
            let mut noises = vec![Remembered::default(); truths.len()];
            for row in 0..self.rows * truths.len() {
                let (truth, noise) = (&truths[row % truths.len()], &mut noises[row % truths.len()]);
                let seen = truth.blurred(&prior::KAPVIK_INSTANT_NOISE, || {
                    noise.next(self.kept, StandardNormal.sample(&mut random))
                });
                writeln!(csv, "{},{row},{}", drawn.len(), readings(&seen)).expect("text");
            }
            drawn.push(soil);
        }
        let csv = without(&csv, self.lacking);
        let toml = description("Drawn from the prior", "", Some(&prior::KAPVIK_INSTANT_NOISE));
        (Campaign::parse(Path::new("drawn.csv"), &csv, &toml).expect("a campaign"), drawn)
    }
}

/// Of the runs that were answered, how many have each parameter within two stated standard deviations and within the 95 % interval, and how many say that they are
/// widened.
#[derive(Debug, Default)]
pub struct Held {
    /// Of c, φ and K.
    pub within: [[usize; 2]; 3],
    /// Runs in which these were answered, and not taken as given.
    pub told: [usize; 3],
    /// Runs.
    pub widened: usize,
}

impl Held {
    /// Of runs on soils that are known.
    pub fn of(document: &Document, soils: &[Soil<f64>]) -> Self {
        let document = serde_json::to_value(document).expect("JSON");
        let mut held = Self::default();
        for (run, soil) in document["runs"].as_array().expect("runs").iter().zip(soils) {
            held.widened += usize::from(run["widened"].is_string());
            let truths = [soil.cohesion_pa, soil.friction_angle_rad, soil.shear_modulus_m];
            let counts = held.within.iter_mut().zip(&mut held.told);
            for (((within, told), key), truth) in counts.zip(KEYS).zip(truths) {
                if run[key]["assumed"] != Value::Bool(false) {
                    continue;
                }
                *told += 1;
                let number = |value: &Value| value.as_f64().expect("a number");
                let (value, std) = (number(&run[key]["value"]), number(&run[key]["std"]));
                let [low, high] = [0, 1].map(|end| number(&run[key]["interval_95"][end]));
                within[0] += usize::from((value - truth).abs() <= 2.0 * std);
                within[1] += usize::from((low..=high).contains(&truth));
            }
        }
        held
    }
}
