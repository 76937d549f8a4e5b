//! Equations 1–11 against an independent adaptive integration, over the whole catalogue and far beyond it.

#[path = "../../firmware/tests/terramechanics/reference.rs"]
mod reference;
#[path = "../../firmware/tests/support/worse.rs"]
mod worse;

use std::ops::Range;

use kapvik_firmware::terramechanics::{Soil, Wheel, WheelForces, wheel_forces};
use kapvik_host::soil_catalogue::{Completion, catalogue};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use reference::Reference;
use worse::worse;

/// Cases for each of driving and braking.
const CASES: usize = if cfg!(debug_assertions) { 1_000 } else { 20_000 };

/// The load can be a small difference of large parts (braking on clay, or a rear contact that pulls the wheel down). No
/// arithmetic of fixed length is then exact to a share of it; the error is measured against this share of its parts.
const LEAST_SHARE: f64 = 0.01;

#[derive(Debug, Clone, Copy)]
struct Case {
    wheel: Wheel<f64>,
    soil: Soil<f64>,
    slip: f64,
    sinkage_m: f64,
}

/// Draws that are the numbers of single precision, so that both precisions are asked the same.
struct Draw(ChaCha8Rng);

impl Draw {
    fn uniform(&mut self, range: Range<f64>) -> f64 {
        f64::from(self.0.random_range(range) as f32)
    }

    fn logarithmic(&mut self, range: Range<f64>) -> f64 {
        f64::from(self.0.random_range(range.start.ln()..range.end.ln()).exp() as f32)
    }

    fn one_in(&mut self, number: u32) -> bool {
        self.0.random_ratio(1, number)
    }

    /// A soil of the catalogue, some of its parameters drawn anew over their range.
    fn soil(&mut self, soils: &[Soil<f64>]) -> Soil<f64> {
        let row = soils[self.0.random_range(0..soils.len())].map(|value| f64::from(value as f32));
        Soil {
            sinkage_exponent: if self.one_in(2) { self.uniform(0.2..1.7) } else { row.sinkage_exponent },
            shear_modulus_m: if self.one_in(2) { self.logarithmic(5e-4..0.05) } else { row.shear_modulus_m },
            peak_stress_c1: self.uniform(0.15..0.5),
            peak_stress_c2: self.uniform(0.0..0.5),
            rebound_ratio: if self.one_in(3) { 0.0 } else { self.uniform(0.0..0.5) },
            ..row
        }
    }

    fn case(&mut self, soils: &[Soil<f64>], slip: Range<f64>) -> Case {
        let radius_m = self.uniform(0.05..0.3);
        let width_m = f64::from((radius_m * self.uniform(0.5..1.5)) as f32);
        let depth = if self.one_in(2) { self.logarithmic(0.01..0.6) } else { self.uniform(0.01..0.6) };
        Case {
            wheel: Wheel { radius_m, width_m },
            soil: self.soil(soils),
            slip: self.uniform(slip),
            sinkage_m: f64::from((depth * radius_m) as f32),
        }
    }
}

/// Greatest errors of the two precisions, of the load.
#[derive(Debug, Clone, Copy, Default)]
struct Errors {
    double: f64,
    single: f64,
    cases: usize,
}

impl Errors {
    fn or(self, other: Self) -> Self {
        Self {
            double: worse(self.double, other.double),
            single: worse(self.single, other.single),
            cases: self.cases + other.cases,
        }
    }

    fn of(case: &Case) -> Option<Self> {
        let Case { wheel, soil, slip, sinkage_m } = *case;
        let exact = reference::forces(&wheel, &soil, slip, sinkage_m);
        // Where the soil carries nothing there is no load to be a share of.
        let measure = exact.load_n.max(LEAST_SHARE * exact.stresses_n);
        if exact.load_n <= 0.0 {
            return None;
        }
        let double = wheel_forces(&wheel, &soil, slip, sinkage_m).expect("in range");
        let narrow = |value: f64| value as f32;
        let single =
            wheel_forces(&wheel.map(narrow), &soil.map(narrow), slip as f32, sinkage_m as f32).expect("in range");
        let single = WheelForces {
            drawbar_pull_n: f64::from(single.drawbar_pull_n),
            load_n: f64::from(single.load_n),
            torque_nm: f64::from(single.torque_nm),
        };
        let error = |found| difference(&exact, found, wheel.radius_m) / measure;
        let errors = Self { double: error(double), single: error(single), cases: 1 };
        assert!(errors.double <= 1e-7, "double precision {:e}: {case:?} {exact:?}", errors.double);
        assert!(errors.single <= 2e-4, "single precision {:e}: {case:?} {exact:?}", errors.single);
        Some(errors)
    }
}

fn difference(exact: &Reference, found: WheelForces<f64>, radius_m: f64) -> f64 {
    let pull = (found.drawbar_pull_n - exact.drawbar_pull_n).abs();
    let load = (found.load_n - exact.load_n).abs();
    let torque = (found.torque_nm - exact.torque_nm).abs() / radius_m;
    worse(worse(pull, load), torque)
}

fn sweep(seed: u64, slip: Range<f64>) -> Errors {
    let rows = catalogue().expect("the data file that is built in reads");
    let soils: Vec<_> = rows.iter().filter_map(|row| row.complete(&Completion::SEED).ok()).collect();
    let mut draw = Draw(ChaCha8Rng::seed_from_u64(seed));
    let cases: Vec<_> = (0..CASES).map(|_| draw.case(&soils, slip.clone())).collect();
    cases.par_iter().filter_map(Errors::of).reduce(Errors::default, Errors::or)
}

#[test]
fn driving() {
    let errors = sweep(1, 0.0..0.95);
    println!("driving: greatest errors {errors:?}");
    assert!(errors.cases > CASES / 2);
}

#[test]
fn braking() {
    let errors = sweep(2, -0.95..0.0);
    println!("braking: greatest errors {errors:?}");
    assert!(errors.cases > CASES / 2);
}
