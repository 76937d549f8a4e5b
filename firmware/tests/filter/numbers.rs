//! Whatever goes in, nothing that is not a number comes out, and what failed is named and counted.

use std::sync::atomic::{AtomicU32, Ordering};

use kapvik_firmware::filter::trial;
use kapvik_firmware::filter::{Fate, Fusion, Gate, Gaussian, Innovation, Prediction, SigmaPointFilter, Spread};
use nalgebra::SMatrix;
use proptest::prelude::*;

use super::mostly::mostly;

const N: usize = 3;
const M: usize = 4;
const RESET_STD: [f32; N] = [1.0, 2.0, 3.0];

/// One of a range, and at times anything.
fn any_number(usual: std::ops::Range<f64>) -> impl Strategy<Value = f32> {
    mostly(usual).prop_map(|value| value as f32)
}

fn any_measurement() -> impl Strategy<Value = Option<f32>> {
    prop_oneof![3 => any_number(-3.0..3.0).prop_map(Some), 1 => Just(None)]
}

fn any_gate() -> impl Strategy<Value = Gate<f32>> {
    prop_oneof![Just(Gate::Open), Just(Gate::one_in_a_thousand()), any_number(0.0..20.0).prop_map(Gate::Above)]
}

/// Models that may give anything: the trial's, with one output of the first call but `calls` replaced.
fn spoilt<const A: usize>(
    value: Option<f32>,
    call: u8,
    model: fn(&[f32; N]) -> [f32; A],
) -> impl Fn(&[f32; N]) -> [f32; A] {
    let calls = std::cell::Cell::new(0);
    move |x| {
        let mut outputs = model(x);
        if let Some(value) = value.filter(|_| calls.get() == call) {
            outputs[usize::from(call) % A] = value;
        }
        calls.set(calls.get() + 1);
        outputs
    }
}

/// Finite mean and covariance, no correlation above one, no negative eigenvalue.
fn check(estimate: &Gaussian<f32, N>) -> Result<(), TestCaseError> {
    prop_assert!(estimate.mean().iter().all(|mean| mean.is_finite()), "{estimate:?}");
    let covariance = SMatrix::<f64, N, N>::from_fn(|i, j| f64::from(estimate.covariance(i, j).expect("two states")));
    prop_assert!(covariance.iter().all(|entry| entry.is_finite()), "{estimate:?}");
    let least = covariance.symmetric_eigenvalues().min();
    prop_assert!(least >= -1e-6 * covariance.norm(), "{covariance} {least}");
    Ok(())
}

fn told_is_finite<const K: usize>(told: &Innovation<f32, K>) -> bool {
    let residuals = told
        .residuals
        .iter()
        .all(|residual| residual.innovation.is_finite() && residual.std.is_finite() && residual.std >= 0.0);
    residuals && told.normalised_square.is_finite() && told.normalised_square >= 0.0
}

/// Runs of [`CASES`] that began, steps of these, and how many of these took measurements.
static BEGUN: AtomicU32 = AtomicU32::new(0);
static STEPS: AtomicU32 = AtomicU32::new(0);
static DONE: AtomicU32 = AtomicU32::new(0);
const CASES: u32 = 20_000;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES))]

    fn numbers_stay_numbers(
        mean in prop::array::uniform3(any_number(-2.0..2.0)),
        std in prop::array::uniform3(any_number(0.01..2.0)),
        (alpha, beta) in (0.0_f32..1.1, 0.0_f32..3.0),
        steps in prop::collection::vec((
            prop::array::uniform3(any_number(0.0..1.0)),
            prop::array::uniform4(any_measurement()),
            prop::array::uniform4(any_number(0.01..1.0)),
            any_gate(),
            (prop::option::of(any_number(-2.0..2.0)), 0_u8..8, 0_u8..5),
        ), 1..6),
    ) {
        let Ok(start) = Gaussian::independent(mean, std) else { return Ok(()) };
        let Some(spread) = Spread::new(alpha, beta) else { return Ok(()) };
        let mut filter = SigmaPointFilter::with_spread(start, RESET_STD, spread).expect("the fall-back is well");
        BEGUN.fetch_add(1, Ordering::Relaxed);
        for (noise, measured, sensor, gate, (value, call, kind)) in steps {
            let resets = filter.resets();
            let prediction = match kind {
                4 => filter.widen(noise[0]),
                0 => filter.predict(spoilt(value, call, trial::process), &noise),
                1 => filter.add_correlated_noise(&[noise, [1.0, -1.0, 0.5]]),
                2 => filter.forget(1, noise[0], noise[1]).unwrap_or(Prediction::Done),
                _ => filter.random_walk(&noise),
            };
            check(filter.estimate())?;
            prop_assert_eq!(filter.resets() - resets, u32::from(prediction == Prediction::Reset));
            let (resets, before) = (filter.resets(), *filter.estimate());
            let told = filter.update(spoilt(value, call, trial::measurement), &measured, &sensor, gate);
            check(filter.estimate())?;
            prop_assert!(told_is_finite::<M>(&told), "{told:?}");
            prop_assert_eq!(filter.resets() - resets, u32::from(told.fusion == Fusion::Reset));
            let used = told.residuals.iter().filter(|residual| residual.fate == Fate::Used).count();
            STEPS.fetch_add(1, Ordering::Relaxed);
            DONE.fetch_add(u32::from(told.fusion == Fusion::Done), Ordering::Relaxed);
            match told.fusion {
                Fusion::Done => prop_assert_eq!(used, told.degrees_of_freedom),
                Fusion::NothingToFuse => prop_assert!(used == 0 && before == *filter.estimate()),
                Fusion::Reset => prop_assert!(used > 0 && before.mean() == filter.estimate().mean()),
            }
        }
    }
}

#[test]
fn nothing_becomes_a_number_that_is_none() {
    numbers_stay_numbers();
    let [begun, steps, done] = [&BEGUN, &STEPS, &DONE].map(|count| count.load(Ordering::Relaxed));
    println!("{begun} of {CASES} runs begin; in {done} of their {steps} steps something is measured");
    assert!(begun >= CASES / 2 && done >= steps / 2, "{begun} of {CASES} runs, {done} of {steps} steps");
}

fn filter() -> SigmaPointFilter<f32, N> {
    let start = Gaussian::independent([1.0, -1.0, 0.5], [0.5; N]).expect("numbers");
    SigmaPointFilter::new(start, RESET_STD).expect("numbers")
}

fn assert_fell_back(filter: &SigmaPointFilter<f32, N>, resets: u32) {
    assert_eq!(filter.estimate().mean(), &[1.0, -1.0, 0.5], "the mean stays");
    assert_eq!(filter.estimate().stds(), RESET_STD);
    assert_eq!(filter.estimate().covariance(0, 1), Some(0.0));
    assert_eq!(filter.resets(), resets);
}

#[test]
fn a_factorisation_that_overflows_falls_back_and_is_counted() {
    let mut one = filter();
    for (count, noise) in [1.5e19, 1e30, f32::INFINITY, f32::NAN].into_iter().enumerate() {
        assert_eq!(one.random_walk(&[0.1, noise, 0.1]), Prediction::Reset);
        assert_fell_back(&one, count as u32 + 1);
    }
    assert_eq!(one.predict(|x| *x, &[0.1, f32::INFINITY, 0.1]), Prediction::Reset);
    assert_fell_back(&one, 5);
    assert_eq!(one.add_correlated_noise(&[[1e30, 1.0, 1.0]]), Prediction::Reset);
    assert_fell_back(&one, 6);
    // A root that single precision holds, with a variance that it does not.
    assert_eq!(one.predict(|x| [x[0], x[1], 1e20 * (x[1] + 1.0)], &[0.1; N]), Prediction::Reset);
    assert_fell_back(&one, 7);
    assert_eq!(one.widen(1e30), Prediction::Reset);
    assert_fell_back(&one, 8);
    // Nearly 10³⁸ standard deviations off and believed: the squared innovation is beyond single precision.
    let told = one.update(|x| *x, &[Some(1e30), None, Some(0.5)], &[0.1; N], Gate::Open);
    assert_eq!((told.fusion, told.degrees_of_freedom, told.normalised_square), (Fusion::Reset, 0, 0.0));
    assert_fell_back(&one, 9);
    // It goes on.
    let told = one.update(|x| *x, &[Some(1.1), Some(-1.0), Some(0.4)], &[0.1; N], Gate::one_in_a_thousand());
    assert_eq!((told.fusion, told.degrees_of_freedom), (Fusion::Done, 3));
    assert!((one.estimate().mean()[0] - 1.1).abs() < 0.01);
}

#[test]
fn a_process_model_that_gives_no_number_leaves_the_mean_and_adds_the_noise() {
    for call in 0..7 {
        for value in [f32::NAN, f32::INFINITY] {
            let mut one = filter();
            let model = spoilt(Some(value), call, |x| *x);
            assert_eq!(one.predict(model, &[1.2; N]), Prediction::ModelNotFinite);
            assert_eq!(one.estimate().mean(), filter().estimate().mean());
            assert!(one.estimate().stds().iter().all(|std| (std - 1.3).abs() < 1e-6));
            assert_eq!(one.resets(), 0);
        }
    }
}

#[test]
fn a_measurement_model_that_gives_no_number_costs_that_measurement_alone() {
    for call in 0..7 {
        let mut one = filter();
        let mut other = filter();
        let told = one.update(spoilt(Some(f32::NAN), call, |x| *x), &[Some(0.9); N], &[0.1; N], Gate::Open);
        let place = usize::from(call) % N;
        let mut measured = [Some(0.9); N];
        measured[place] = None;
        let expected = other.update(|x| *x, &measured, &[0.1; N], Gate::Open);
        assert_eq!(told.residuals[place].fate, Fate::NotFinite);
        assert_eq!(told.residuals[place].normalised(), None);
        assert_eq!((told.fusion, told.degrees_of_freedom), (Fusion::Done, 2));
        assert_eq!(told.normalised_square, expected.normalised_square);
        assert_eq!(one.estimate(), other.estimate());
    }
}

#[test]
fn a_sensor_without_noise_or_with_no_number_for_it_is_not_used() {
    for noise in [0.0, -0.1, 1e-25, 1e25, f32::NAN, f32::INFINITY] {
        let mut one = filter();
        let told = one.update(|x| *x, &[Some(0.9); N], &[0.1, noise, 0.1], Gate::Open);
        let fates = told.residuals.map(|residual| residual.fate);
        assert_eq!(fates, [Fate::Used, Fate::NotFinite, Fate::Used], "{noise}");
        assert_eq!(one.estimate().stds()[1], 0.5);
    }
}

#[test]
fn a_state_that_is_known_exactly_stays_so() {
    let start = Gaussian::independent([1.0_f32, 2.0], [0.0, 1.0]).expect("numbers");
    let mut filter = SigmaPointFilter::new(start, [1.0; 2]).expect("numbers");
    assert_eq!(filter.random_walk(&[0.0, 0.1]), Prediction::Done);
    let told = filter.update(|[a, b]| [a + b], &[Some(3.5)], &[0.1], Gate::Open);
    assert_eq!(told.fusion, Fusion::Done);
    assert_eq!((filter.estimate().mean()[0], filter.estimate().variances()[0]), (1.0, 0.0));
    assert!(filter.estimate().mean()[1] > 2.4);
}
