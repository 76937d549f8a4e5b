//! Equations 1–11 as the model: not linear, and with parameters that the data hardly tell apart.

use kapvik_firmware::terramechanics::Wheel;
use rand::RngExt;

use super::toy::{agreeing, free, normal, random};
use crate::diagnose::fit::{
    CHANNELS, Coordinate, Derivatives, Fit, HeldOut, Latent, Model, Options, Prediction, Row, Start, fit,
    fit_from_many, scattered_starts,
};
use crate::limit::coordinates::{Coordinates, DIMENSION};
use crate::limit::response::respond;

const WHEEL: Wheel<f64> = Wheel { radius_m: 0.075, width_m: 0.07 };
const NOISE: [f64; CHANNELS] = [0.6, 0.06, 0.0007, 1.0, 0.01, 0.8];
const OFFSET: [f64; CHANNELS] = [0.5, 0.05, 0.0005, 0.0, 0.0, 0.0];

/// A soil in coordinates of which the prior is standard normal.
struct Soil(Vec<Coordinate>);

impl Soil {
    fn new() -> Self {
        let coordinate =
            |axis| Coordinate { low: -4.0, high: 4.0, prior: Some((0.0, 1.0)), ..free(&format!("soil {axis}")) };
        Self((0..DIMENSION).map(coordinate).collect())
    }
}

impl Model for Soil {
    fn coordinates(&self) -> &[Coordinate] {
        &self.0
    }

    fn predict(&self, parameters: &[f64], _: &[usize], latents: &mut [Latent]) -> Option<Vec<Prediction>> {
        let point = Coordinates::from_column_slice(parameters);
        let predict = |latent: &mut Latent| {
            let found = respond(&WHEEL, &point, latent.slip, latent.load_n, latent.sinkage_m)?;
            latent.sinkage_m = found.value[2];
            let channels = |by: &crate::limit::response::Channels, slip, load| [by[0], by[1], by[2], 0.0, slip, load];
            Some(Prediction {
                value: channels(&found.value, latent.slip, latent.load_n),
                slopes: Derivatives {
                    by_parameter: found.by_soil.column_iter().map(|by| channels(&by.into_owned(), 0.0, 0.0)).collect(),
                    by_slip: channels(&found.by_slip, 1.0, 0.0),
                    by_load: channels(&found.by_load, 0.0, 1.0),
                },
            })
        };
        latents.iter_mut().map(predict).collect()
    }
}

/// A soil of the prior and runs on it.
fn campaign(runs: usize, size: usize, seed: u64) -> (Vec<f64>, Vec<Row>) {
    campaign_of_noise(1.0, runs, size, seed)
}

/// The same with forces and torques `share` times as noisy.
fn campaign_of_noise(share: f64, runs: usize, size: usize, seed: u64) -> (Vec<f64>, Vec<Row>) {
    let noise: [f64; CHANNELS] = std::array::from_fn(|c| if c < 2 { share * NOISE[c] } else { NOISE[c] });
    let mut random = random(seed);
    let truth: Vec<f64> = (0..DIMENSION).map(|_| 0.7 * normal(&mut random)).collect();
    let mut rows = Vec::new();
    for run in 0..runs {
        let offset: [f64; CHANNELS] = std::array::from_fn(|c| OFFSET[c] * normal(&mut random));
        let load = random.random_range(30.0..90.0);
        for _ in 0..size {
            let mut latent = [Latent { slip: random.random_range(0.03..0.6), load_n: load, sinkage_m: 0.01 }];
            let value = Soil::new().predict(&truth, &[0], &mut latent).unwrap()[0].value;
            let reading = |c: usize| (c != 3).then(|| value[c] + share * offset[c] + noise[c] * normal(&mut random));
            rows.push(Row { run, readings: std::array::from_fn(reading), noise });
        }
    }
    (truth, rows)
}

fn options() -> Options {
    Options::default()
}

const RUNS: usize = 15;

fn fitted(seed: u64) -> (Vec<f64>, Vec<Row>, Fit) {
    let (truth, rows) = campaign(RUNS, 4, seed);
    let fit = fit(&Soil::new(), &rows, &Start::of(&Soil::new(), &rows), &options()).unwrap();
    (truth, rows, fit)
}

/// In these coordinates the posterior is a bent valley, of which a covariance is a poor picture; that twice the difference in
/// log posterior has the χ² distribution (Wilks 1938, Ann. Math. Statist. 9:60) holds in any.
#[test]
fn the_true_soil_is_as_likely_as_a_truth_should_be() {
    let (mut ratios, mut converged) = (0.0, 0);
    for seed in 0..30 {
        let (truth, rows, found) = fitted(seed);
        let mut pinned = Soil::new();
        for (coordinate, value) in pinned.0.iter_mut().zip(&truth) {
            *coordinate = Coordinate { low: value - 1e-7, high: value + 1e-7, start: *value, ..coordinate.clone() };
        }
        let at_truth = fit(&pinned, &rows, &Start::of(&pinned, &rows), &options()).unwrap();
        ratios += 2.0 * (found.log_posterior - at_truth.log_posterior);
        converged += usize::from(found.converged);
    }
    // Thirty times seven degrees of freedom: 210 ± 20.
    assert!((140.0..280.0).contains(&ratios), "{ratios}");
    assert!(converged >= 29, "{converged}");
}

#[test]
fn nearly_all_starts_come_to_one_optimum() {
    for seed in 0..5 {
        let (_, rows, one) = fitted(seed);
        let starts = scattered_starts(&Soil::new(), &rows, 8, 3);
        let [agreed, fitted] = agreeing(&Soil::new(), &rows, &starts, &options());
        assert!(agreed >= 6 && fitted == 8, "{agreed} of {fitted}");
        let best = fit_from_many(&Soil::new(), &rows, &[], &starts, &options()).unwrap();
        assert!(one.log_posterior > best.log_posterior - 0.1);
    }
}

/// Far from precise readings the loss says nothing of how far.
#[test]
fn from_afar_a_fit_finds_its_way_to_precise_readings() {
    let mut agreed = 0;
    for seed in 0..5 {
        let (_, rows) = campaign_of_noise(0.01, RUNS, 4, seed);
        let starts = scattered_starts(&Soil::new(), &rows, 8, 3);
        agreed += agreeing(&Soil::new(), &rows, &starts, &options())[0];
    }
    assert!(agreed >= 36, "{agreed} of 40");
}

#[test]
fn one_step_without_a_run_is_near_to_the_refit() {
    for seed in 0..3 {
        let (_, _, fit) = fitted(seed);
        let score = |held: Result<HeldOut, _>| held.ok().and_then(|held: HeldOut| held.log_score()).unwrap();
        let total = |one: &dyn Fn(usize) -> f64| (0..RUNS).map(one).sum::<f64>();
        let quick = total(&|run| score(fit.leave_out(&Soil::new(), &[run])));
        let exact = total(&|run| score(fit.leave_out_exact(&Soil::new(), &[run])));
        assert!((quick - exact).abs() < 0.2 * RUNS as f64, "{quick} {exact}");
    }
}

#[test]
fn what_is_predicted_unseen_is_as_uncertain_as_it_says() {
    let (mut inside, mut all) = (0, 0);
    for seed in 30..42 {
        let (_, _, fit) = fitted(seed);
        for run in 0..RUNS {
            for row in &fit.leave_out(&Soil::new(), &[run]).unwrap().runs[0].rows {
                for (residual, std) in row.residual.iter().zip(&row.std) {
                    let (Some(residual), Some(std)) = (residual, std) else { continue };
                    inside += usize::from(residual.abs() < 0.6745 * std);
                    all += 1;
                }
            }
        }
    }
    // Rows of a run share an offset: 540 groups, one for each channel of a run.
    let share = inside as f64 / all as f64;
    assert!((share - 0.5).abs() < 4.0 * 0.5 / 540.0_f64.sqrt(), "{share}");
}
