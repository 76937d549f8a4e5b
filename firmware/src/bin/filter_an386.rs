//! The filter alone, without anything that prints: an update, predictions by a model, by drift and with correlated noise, one state forgotten,
//! and variances read off the estimate. No panic may be linked into this image.
#![no_std]
#![no_main]

use core::hint::black_box;

use kapvik_board_an386::{entry, exit};
use kapvik_firmware::filter::trial::{self, Scales, Trial};
use kapvik_firmware::filter::{Fusion, Gate, Gaussian, Prediction, SigmaPointFilter, Spread};

#[entry]
fn main() -> ! {
    let done = steps::<3, 2>() && steps::<6, 6>() && steps::<9, 12>() && steps::<12, 18>();
    exit(i32::from(!done))
}

/// Whether steps of every kind end well.
fn steps<const N: usize, const M: usize>() -> bool {
    let scales = Scales::NOMINAL;
    let std = black_box([scales.start_std; N]);
    let Some(spread) = Spread::new(black_box(1.0), black_box(2.0)) else { return false };
    let start = Gaussian::independent([0.0; N], std);
    let Ok(mut filter) = start.and_then(|start| SigmaPointFilter::with_spread(start, std, spread)) else {
        return false;
    };
    let noise = black_box([scales.process_std; N]);
    let measured = Trial::<N, M>::new(1, scales).measure().map(Some);
    let told =
        filter.update(trial::measurement, &measured, &black_box([scales.noise_std; M]), Gate::one_in_a_thousand());
    let predictions = [
        filter.random_walk(&noise),
        filter.predict(trial::process, &noise),
        filter.add_correlated_noise(&[noise, noise]),
        filter.forget(black_box(1), 0.0, scales.start_std).unwrap_or(Prediction::Reset),
    ];
    let estimate = filter.estimate();
    let (_, variance) = estimate.weighted_sum(&noise);
    let covariance = estimate.covariance(black_box(0), black_box(1)).unwrap_or(f32::NAN);
    told.fusion == Fusion::Done
        && predictions.iter().all(|prediction| *prediction == Prediction::Done)
        && estimate.stds().iter().chain([&variance, &covariance]).all(|value| value.is_finite())
}
