//! A line through points of which both coordinates are measured with error (Deming 1943, Statistical Adjustment of Data).

use super::toy::{blank, free, normal, plain, random};
use crate::diagnose::fit::{Coordinate, Derivatives, Latent, Model, Prediction, Reading, Row, Start, fit};

/// Drawbar pull `a + b s` against slip s.
struct Line([Coordinate; 2]);

impl Model for Line {
    fn coordinates(&self) -> &[Coordinate] {
        &self.0
    }

    fn predict(&self, parameters: &[f64], _: &[usize], latents: &mut [Latent]) -> Option<Vec<Prediction>> {
        let predict = |latent: &Latent| Prediction {
            value: [parameters[0] + parameters[1] * latent.slip, 0.0, 0.0, 0.0, latent.slip, latent.load_n],
            slopes: Derivatives {
                by_parameter: vec![[1.0, 0.0, 0.0, 0.0, 0.0, 0.0], [latent.slip, 0.0, 0.0, 0.0, 0.0, 0.0]],
                by_slip: [parameters[1], 0.0, 0.0, 0.0, 1.0, 0.0],
                by_load: [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
            },
        };
        Some(latents.iter().map(predict).collect())
    }
}

const SLIP_NOISE: f64 = 0.08;
const PULL_NOISE: f64 = 0.3;

fn readings(seed: u64) -> (Vec<f64>, Vec<f64>) {
    let mut random = random(seed);
    let truth = (0..40).map(|i| 0.02 * f64::from(i));
    truth.map(|x| (x + SLIP_NOISE * normal(&mut random), 1.0 + 4.0 * x + PULL_NOISE * normal(&mut random))).unzip()
}

/// Deming's slope and intercept: δ is the ratio of the noise variances.
fn deming(x: &[f64], y: &[f64]) -> (f64, f64) {
    let count = x.len() as f64;
    let delta = (PULL_NOISE / SLIP_NOISE).powi(2);
    let (mean_x, mean_y) = (x.iter().sum::<f64>() / count, y.iter().sum::<f64>() / count);
    let product = |a: &[f64], mean_a: f64, b: &[f64], mean_b: f64| -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - mean_a) * (b - mean_b)).sum::<f64>() / count
    };
    let (xx, xy, yy) = (product(x, mean_x, x, mean_x), product(x, mean_x, y, mean_y), product(y, mean_y, y, mean_y));
    let difference = yy - delta * xx;
    let slope = (difference + (difference * difference + 4.0 * delta * xy * xy).sqrt()) / (2.0 * xy);
    (mean_y - slope * mean_x, slope)
}

#[test]
fn a_line_with_error_in_both_coordinates_is_demings() {
    for seed in 0..5 {
        let (x, y) = readings(seed);
        let row = |(index, (&x, &y)): (usize, (&f64, &f64))| {
            let mut row = blank(index);
            row.readings[Reading::Slip.index()] = Some(x);
            row.readings[Reading::DrawbarPull.index()] = Some(y);
            row.noise[Reading::Slip.index()] = SLIP_NOISE;
            row.noise[Reading::DrawbarPull.index()] = PULL_NOISE;
            row
        };
        let rows: Vec<Row> = x.iter().zip(&y).enumerate().map(row).collect();
        let model = Line([free("a"), free("b")]);
        let mut options = plain();
        options.latent_prior_std[0] = 1e4;
        options.tolerance = 1e-10;
        let fit = fit(&model, &rows, &Start::of(&model, &rows), &options).unwrap();
        let (intercept, slope) = deming(&x, &y);
        assert!(fit.converged);
        assert!((fit.parameters[1] - slope).abs() < 1e-4, "{:?}, {slope}", fit.parameters);
        assert!((fit.parameters[0] - intercept).abs() < 1e-4, "{:?}, {intercept}", fit.parameters);
        // One reading per row goes into its slip, two into the line.
        assert!((fit.degrees_of_freedom - 38.0).abs() < 0.5, "{}", fit.degrees_of_freedom);
    }
}
