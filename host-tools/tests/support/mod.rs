//! Campaigns made by the equations.

#[path = "../columns/mod.rs"]
mod columns;

use std::fmt::Write;

use kapvik_firmware::terramechanics::{Soil, sinkage_for_load, wheel_forces};
use kapvik_host::prior::KAPVIK_WHEEL;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

pub use columns::COLUMNS;

/// The description of a made campaign: the rover's wheel and the noise of its sensors.
pub const TOML: &str = "\
name = \"Made by the equations\"
kind = \"simulated\"
source = \"equations 1–11\"
gravity_m_s2 = 9.81
[wheel]
radius_m = 0.075
width_m = 0.070
[soil]
n = { value = 1.1, std = 0.05 }
[noise]
drawbar_pull_n = 0.5
load_n = 1.0
torque_nm = 0.05
slip = 0.01
sinkage_m = 0.002
";

/// Six wheels at slips 0.05 … 0.60 on one soil.
pub struct Made {
    /// Names of the runs, and how many instants each has.
    pub runs: Vec<(&'static str, usize)>,
    /// The soil.
    pub soil: Soil<f64>,
    /// Whether the sensors' noise is added.
    pub noisy: bool,
}

impl Default for Made {
    fn default() -> Self {
        let soil = Soil {
            sinkage_exponent: 1.1,
            cohesive_modulus: 15.6e3,
            frictional_modulus: 2407.4e3,
            cohesion_pa: 250.0,
            friction_angle_rad: 0.557,
            shear_modulus_m: 0.0114,
            peak_stress_c1: 0.18,
            peak_stress_c2: 0.32,
            rebound_ratio: 0.0,
        };
        Self { runs: vec![("a", 1), ("b", 2)], soil, noisy: true }
    }
}

impl Made {
    /// The table.
    pub fn csv(&self) -> String {
        let mut random = ChaCha8Rng::seed_from_u64(11);
        let mut blur = |value: f64, std: f64| {
            let normal: f64 = StandardNormal.sample(&mut random);
            if self.noisy { value + std * normal } else { value }
        };
        let mut csv = format!("{COLUMNS}\n");
        for (run, instants) in &self.runs {
            for (instant, place) in (0..*instants).flat_map(|instant| (0..6).map(move |place| (instant, place))) {
                let (slip, load) = (0.05 + 0.11 * f64::from(place), 60.0 + 2.0 * f64::from(place));
                let sinkage = sinkage_for_load(&KAPVIK_WHEEL, &self.soil, slip, load).expect("the soil carries it");
                let forces = wheel_forces(&KAPVIK_WHEEL, &self.soil, slip, sinkage).expect("forces");
                let (slip, load) = (blur(slip, 0.01), blur(load, 1.0));
                let (pull, torque) = (blur(forces.drawbar_pull_n, 0.5), blur(forces.torque_nm, 0.05));
                let sinkage = blur(sinkage, 0.002);
                writeln!(csv, "{run},{instant},{slip:.5},{load:.4},{pull:.4},{torque:.5},{sinkage:.6}").expect("text");
            }
        }
        csv
    }
}
