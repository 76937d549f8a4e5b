//! The sigma-point filter against an independent Kalman filter, closed forms, its own statistics, and whatever can go wrong.

mod gate;
mod limits;
mod linear;
mod missing;
#[path = "../support/mostly.rs"]
mod mostly;
mod numbers;
mod precision;
mod statistics;
#[path = "../support/worse.rs"]
mod worse;

use kapvik_firmware::filter::trial::{self, Scales};
use kapvik_firmware::filter::{Gate, Gaussian, Innovation, Prediction, SigmaPointFilter};
use kapvik_firmware::scalar::Scalar;

/// A filter that knows the trial's scales.
fn start<T: Scalar, const N: usize>(scales: &Scales) -> SigmaPointFilter<T, N> {
    let std = [T::constant(f64::from(scales.start_std)); N];
    let start = Gaussian::independent([T::zero(); N], std).expect("numbers");
    SigmaPointFilter::new(start, std).expect("numbers")
}

fn predict<T: Scalar, const N: usize>(filter: &mut SigmaPointFilter<T, N>, scales: &Scales) -> Prediction {
    filter.predict(trial::process, &[T::constant(f64::from(scales.process_std)); N])
}

fn update<T: Scalar, const N: usize, const M: usize>(
    filter: &mut SigmaPointFilter<T, N>,
    scales: &Scales,
    measured: &[Option<T>; M],
    gate: Gate<T>,
) -> Innovation<T, M> {
    filter.update(trial::measurement, measured, &[T::constant(f64::from(scales.noise_std)); M], gate)
}

/// The bits of an estimate: mean and covariance.
fn bits<const N: usize>(estimate: &Gaussian<f32, N>) -> Vec<u32> {
    let covariances = (0..N).flat_map(|i| (0..N).map(move |j| estimate.covariance(i, j).expect("two states")));
    estimate.mean().iter().copied().chain(covariances).map(f32::to_bits).collect()
}
