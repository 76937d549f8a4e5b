//! Cases whose answer is known in closed form.

use kapvik_firmware::filter::{Fusion, Gate, Gaussian, InvalidNumber, Prediction, SigmaPointFilter, Spread};
use proptest::prelude::*;

fn filter<const N: usize>(mean: [f64; N], std: [f64; N]) -> SigmaPointFilter<f64, N> {
    SigmaPointFilter::new(Gaussian::independent(mean, std).expect("numbers"), std).expect("numbers")
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * (1.0 + a.abs().max(b.abs()))
}

proptest! {
    #[test]
    fn the_square_of_a_normal_number_has_its_mean_and_variance(mean in -10.0..10.0, std in 0.0..5.0) {
        let mut one = filter([mean], [std]);
        prop_assert_eq!(one.predict(|[x]| [x * x], &[0.0]), Prediction::Done);
        let [variance] = one.estimate().variances();
        prop_assert!(close(one.estimate().mean()[0], mean * mean + std * std));
        prop_assert!(close(variance, 4.0 * mean * mean * std * std + 2.0 * std.powi(4)));
    }

    #[test]
    fn drifting_adds_variances(std in prop::array::uniform3(0.0..5.0), noise in prop::array::uniform3(0.0..5.0)) {
        let mut three = filter([1.0, 2.0, 3.0], std);
        prop_assert_eq!(three.random_walk(&noise), Prediction::Done);
        prop_assert_eq!(three.estimate().mean(), &[1.0, 2.0, 3.0]);
        for (i, variance) in three.estimate().variances().into_iter().enumerate() {
            prop_assert!(close(variance, std[i] * std[i] + noise[i] * noise[i]));
        }
    }

    #[test]
    fn shared_noise_adds_its_covariance(
        std in prop::array::uniform3(0.0..5.0),
        one in prop::array::uniform3(-5.0..5.0),
        other in prop::array::uniform3(-5.0..5.0),
    ) {
        let mut three = filter([0.0; 3], std);
        prop_assert_eq!(three.add_correlated_noise(&[one, other]), Prediction::Done);
        for i in 0..3 {
            for j in 0..3 {
                let before = if i == j { std[i] * std[i] } else { 0.0 };
                let covariance = three.estimate().covariance(i, j).expect("two states");
                prop_assert!(close(covariance, before + one[i] * one[j] + other[i] * other[j]));
            }
        }
    }

    #[test]
    fn one_measurement_of_a_number_weighs_by_variances(mean in -10.0..10.0, std in 0.01..5.0, noise in 0.01..5.0, measured in -10.0..10.0) {
        let mut one = filter([mean], [std]);
        let told = one.update(|x| *x, &[Some(measured)], &[noise], Gate::Open);
        let (prior, sensor) = (std * std, noise * noise);
        prop_assert_eq!(told.fusion, Fusion::Done);
        prop_assert!(close(one.estimate().mean()[0], (mean * sensor + measured * prior) / (prior + sensor)));
        prop_assert!(close(one.estimate().variances()[0], prior * sensor / (prior + sensor)));
        prop_assert!(close(told.normalised_square, (measured - mean).powi(2) / (prior + sensor)));
        let [residual] = told.residuals;
        prop_assert!(close(residual.innovation, measured - mean));
        prop_assert!(close(residual.std, (prior + sensor).sqrt()));
        prop_assert!(close(residual.normalised().expect("used").powi(2), told.normalised_square));
    }
}

#[test]
fn what_bends_in_the_measurement_counts_as_noise() {
    // y = x² about zero: no slope, so the state learns nothing; the innovation has the variance of a squared normal number.
    let mut one = filter([0.0], [2.0]);
    let told = one.update(|[x]| [x * x], &[Some(30.0)], &[3.0], Gate::Open);
    let [residual] = told.residuals;
    assert!(close(residual.innovation, 30.0 - 4.0));
    assert!(close(residual.std, (2.0 * 16.0 + 9.0_f64).sqrt()));
    assert!(close(one.estimate().variances()[0], 4.0) && close(one.estimate().mean()[0], 0.0));
}

#[test]
fn forgetting_a_state_leaves_the_others_as_they_were() {
    let mut three = filter([1.0, 2.0, 3.0], [1.0, 2.0, 3.0]);
    assert_eq!(three.add_correlated_noise(&[[1.0, -1.0, 2.0]]), Prediction::Done);
    assert_eq!(three.forget(1, 7.0, 0.5), Ok(Prediction::Done));
    assert_eq!(three.estimate().mean(), &[1.0, 7.0, 3.0]);
    let expected = [[2.0, 0.0, 2.0], [0.0, 0.25, 0.0], [2.0, 0.0, 13.0]];
    for (i, row) in expected.iter().enumerate() {
        for (j, covariance) in row.iter().enumerate() {
            assert!(close(three.estimate().covariance(i, j).expect("two states"), *covariance), "{i} {j}");
        }
    }
    assert_eq!(three.forget(0, f64::NAN, 1.0), Err(InvalidNumber::Mean));
    assert_eq!(three.forget(0, 0.0, -1.0), Err(InvalidNumber::StandardDeviation));
    assert_eq!(three.estimate().mean(), &[1.0, 7.0, 3.0]);
}

#[test]
fn impossible_numbers_are_refused_at_the_start() {
    for mean in [f64::NAN, f64::INFINITY] {
        assert_eq!(Gaussian::independent([0.0, mean], [1.0; 2]), Err(InvalidNumber::Mean));
    }
    for std in [f64::NAN, f64::INFINITY, -1.0] {
        assert_eq!(Gaussian::independent([0.0; 2], [1.0, std]), Err(InvalidNumber::StandardDeviation));
        let start = Gaussian::independent([0.0; 2], [1.0; 2]).expect("numbers");
        assert_eq!(SigmaPointFilter::new(start, [1.0, std]).err(), Some(InvalidNumber::StandardDeviation));
    }
    assert_eq!(Gaussian::independent([0.0; 2], [1.0; 2]).expect("numbers").covariance(0, 2), None);
}

#[test]
fn sigma_points_that_single_precision_cannot_tell_apart_are_refused() {
    for (alpha, beta) in [(0.0099, 2.0), (1.001, 2.0), (f64::NAN, 2.0), (1.0, -0.1), (1.0, f64::INFINITY)] {
        assert_eq!(Spread::new(alpha, beta), None, "{alpha} {beta}");
    }
    assert_eq!(Spread::new(1.0, 2.0), Some(Spread::unit()));
    assert!(Spread::new(0.01, 0.0).is_some());
}

#[test]
fn the_spread_does_not_matter_to_a_straight_model() {
    let start = Gaussian::independent([1.0, -1.0], [2.0, 0.5]).expect("numbers");
    for (alpha, beta) in [(0.01, 2.0), (0.5, 0.0), (1.0, 0.0)] {
        let spread = Spread::new(alpha, beta).expect("in bounds");
        let mut other = SigmaPointFilter::with_spread(start, [1.0; 2], spread).expect("numbers");
        assert_eq!(other.predict(|[a, b]| [a + b, a - 2.0 * b], &[0.1, 0.2]), Prediction::Done);
        // Var(a + b) = 4 + 0.25, Var(a − 2 b) = 4 + 1, Cov = 4 − 2 · 0.25, and the noise.
        let expected = [[4.26_f64, 3.5], [3.5, 5.04]];
        for (i, row) in expected.iter().enumerate() {
            for (j, covariance) in row.iter().enumerate() {
                let found = other.estimate().covariance(i, j).expect("two states");
                assert!((found - covariance).abs() < 1e-9, "{alpha} {beta}: {found} {covariance}");
            }
        }
    }
}
