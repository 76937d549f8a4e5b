//! Weighted least squares.

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

use super::dense::Dense;
use super::toy::{Linear, Terms, blank, campaign, free, normal, plain, random};
use crate::diagnose::fit::{CHANNELS, Coordinate, Reading, Row, Start, fit};

/// Readings of the drawbar pull that no latent moves: `y = a + b x`.
fn line(count: usize, seed: u64) -> (Linear, Vec<Row>, DMatrix<f64>, DVector<f64>, DVector<f64>) {
    let mut random = random(seed);
    let x = DMatrix::from_fn(count, 2, |i, p| if p == 0 { 1.0 } else { i as f64 / count as f64 });
    let noise = DVector::from_fn(count, |i, _| 0.1 + 0.05 * (i % 3) as f64);
    let y = DVector::from_fn(count, |i, _| 1.0 + 2.0 * x[(i, 1)] + noise[i] * normal(&mut random));
    let terms = |i: usize| Terms {
        constant: [0.0; CHANNELS],
        parameters: (0..2).map(|p| [x[(i, p)], 0.0, 0.0, 0.0, 0.0, 0.0]).collect(),
        slip: [0.0; CHANNELS],
        load: [0.0; CHANNELS],
    };
    let model = Linear { coordinates: vec![free("a"), free("b")], terms: (0..count).map(terms).collect() };
    let row = |i: usize| {
        let mut row = blank(i);
        row.readings[0] = Some(y[i]);
        row.noise[0] = noise[i];
        row
    };
    let rows = (0..count).map(row).collect();
    (model, rows, x, y, noise)
}

#[test]
fn weighted_least_squares_is_its_closed_form() {
    let (model, rows, x, y, noise) = line(20, 1);
    let fit = fit(&model, &rows, &Start::of(&model, &rows), &plain()).unwrap();
    let weight = DMatrix::from_diagonal(&noise.map(|std| 1.0 / (std * std)));
    let covariance = (x.transpose() * &weight * &x).try_inverse().unwrap();
    let expected = &covariance * x.transpose() * &weight * &y;
    assert!(fit.converged);
    for p in 0..2 {
        assert!((fit.parameters[p] - expected[p]).abs() < 1e-6, "{:?} {expected}", fit.parameters);
        for q in 0..2 {
            assert!((fit.covariance[(p, q)] - covariance[(p, q)]).abs() < 1e-6 * covariance[(0, 0)]);
        }
    }
    let chi2 = (&y - &x * &expected).component_div(&noise).norm_squared();
    assert!((fit.degrees_of_freedom - 18.0).abs() < 1e-6, "{}", fit.degrees_of_freedom);
    assert!((fit.dispersion - chi2 / 18.0).abs() < 1e-6);
}

#[test]
fn a_gaussian_prior_counts_like_a_reading() {
    let (mut model, rows, x, y, noise) = line(5, 2);
    model.coordinates[1].prior = Some((3.0, 0.1));
    let fit = fit(&model, &rows, &Start::of(&model, &rows), &plain()).unwrap();
    let weight = DMatrix::from_diagonal(&noise.map(|std| 1.0 / (std * std)));
    let prior = DMatrix::from_diagonal(&DVector::from_vec(vec![0.0, 100.0]));
    let covariance = (x.transpose() * &weight * &x + prior).try_inverse().unwrap();
    let expected = &covariance * (x.transpose() * &weight * &y + DVector::from_vec(vec![0.0, 300.0]));
    assert!((fit.parameters[0] - expected[0]).abs() < 1e-6 && (fit.parameters[1] - expected[1]).abs() < 1e-6);
    let ln_prior = -0.5 * ((expected[1] - 3.0) / 0.1).powi(2) - (0.1 * (2.0 * std::f64::consts::PI).sqrt()).ln();
    assert!((fit.log_posterior - fit.log_likelihood - ln_prior).abs() < 1e-5);
}

#[test]
fn noise_that_is_not_stated_is_the_unbiased_standard_deviation() {
    let (model, mut rows, x, y, noise) = line(30, 3);
    // Told ten times too small; what is right is how the readings compare.
    rows.iter_mut().for_each(|row| row.noise[0] *= 0.1);
    let mut options = plain();
    options.estimate_noise[0] = true;
    let fit = fit(&model, &rows, &Start::of(&model, &rows), &options).unwrap();
    let weight = DMatrix::from_diagonal(&noise.map(|std| 1.0 / (std * std)));
    let expected = (x.transpose() * &weight * &x).try_inverse().unwrap() * x.transpose() * &weight * &y;
    let std = 10.0 * ((&y - &x * expected).component_div(&noise).norm_squared() / 28.0).sqrt();
    assert!(fit.converged);
    assert!((fit.noise_scale[0] / std - 1.0).abs() < 1e-3, "{} {std}", fit.noise_scale[0]);
}

#[test]
fn a_coordinate_that_no_reading_moves_keeps_the_spread_of_its_bounds() {
    let (mut model, rows, ..) = line(10, 4);
    model.coordinates.push(Coordinate { low: -1.0, high: 2.0, start: 0.3, ..free("idle") });
    model.terms.iter_mut().for_each(|terms| terms.parameters.push([0.0; CHANNELS]));
    let fit = fit(&model, &rows, &Start::of(&model, &rows), &plain()).unwrap();
    assert!((fit.parameters[2] - 0.3).abs() < 1e-9);
    assert!((fit.covariance[(2, 2)] - 0.75).abs() < 1e-9);
    assert!(!fit.on_bound[2]);
}

#[test]
fn a_model_without_coordinates_is_scored_as_it_is() {
    let (mut model, rows) = campaign(&[3; 4], 2, 5);
    model.coordinates.clear();
    model.terms.iter_mut().for_each(|terms| terms.parameters.clear());
    let options = crate::diagnose::fit::Options { latent_prior_std: [1.0, 100.0], ..plain() };
    let fit = fit(&model, &rows, &Start::of(&model, &rows), &options).unwrap();
    let dense = Dense::new(&model, &rows, &options, &[0.0; CHANNELS], &[1.0; CHANNELS]);
    assert!(fit.converged && fit.parameters.is_empty());
    assert!((fit.log_likelihood - dense.ln_density(&[])).abs() < 1e-4);
    assert!(fit.leave_out(&model, &[1]).unwrap().log_score().is_some());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn estimate_and_density_are_those_of_the_dense_gaussian(seed in 0_u64..1000, runs in 3_usize..6, size in 1_usize..4) {
        let (model, rows) = campaign(&vec![size; runs], 2, seed);
        // Slip and load priors that a dense matrix can bear.
        let options = crate::diagnose::fit::Options { latent_prior_std: [1.0, 100.0], ..plain() };
        let fit = fit(&model, &rows, &Start::of(&model, &rows), &options).unwrap();
        let dense = Dense::new(&model, &rows, &options, &[0.0; CHANNELS], &[1.0; CHANNELS]);
        let (parameters, covariance) = dense.estimate();
        for p in 0..2 {
            prop_assert!((fit.parameters[p] - parameters[p]).abs() < 1e-4 * covariance[(p, p)].sqrt());
            prop_assert!((fit.covariance[(p, p)] / covariance[(p, p)] - 1.0).abs() < 1e-5);
        }
        let expected = dense.ln_density(parameters.as_slice());
        prop_assert!((fit.log_likelihood - expected).abs() < 1e-5, "{} {expected}", fit.log_likelihood);
    }
}

/// A load cell that reads a share of the load tells as much of it as one that reads it all.
#[test]
fn a_sensor_that_shrinks_its_readings_explains_nothing_by_it() {
    let (model, rows) = campaign(&[5; 4], 2, 7);
    let likelihood = |share: f64| {
        let mut model = model.clone();
        for terms in &mut model.terms {
            terms.load = [0.0; CHANNELS];
            terms.load[Reading::Load.index()] = share;
        }
        fit(&model, &rows, &Start::of(&model, &rows), &plain()).unwrap().log_likelihood
    };
    assert!((likelihood(0.8) - likelihood(1.0)).abs() < 1e-3, "{} {}", likelihood(0.8), likelihood(1.0));
}
