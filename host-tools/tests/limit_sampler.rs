//! The sampler on densities whose moments are known, and the diagnostics on chains whose correlation is known.

use kapvik_firmware::dual::Dual;
use kapvik_firmware::scalar::Scalar;
use kapvik_host::limit::density::LogDensity;
use kapvik_host::limit::diagnostics::Diagnosis;
use kapvik_host::limit::sampler::{Draws, Effort, sample};
use kapvik_host::limit::student::Student;
use kapvik_host::train::dataset::stream;
use nalgebra::{Matrix3, SVector, Vector3};
use rand_distr::{Distribution, StandardNormal};

const EFFORT: Effort = Effort {
    chains: 8,
    rounds: 2,
    round_steps: 20,
    batch_steps: 200,
    effective_size: 2000.0,
    split_r_hat: 1.02,
    batches: 40,
};

/// Standard errors that one of the few dozen comparisons here exceeds once in some ten thousand seeds.
const ERRORS: f64 = 4.5;

/// A normal distribution whose standard deviations differ a hundredfold, all strongly correlated.
struct Normal {
    mean: Vector3<f64>,
    precision: Matrix3<f64>,
}

impl LogDensity<3> for Normal {
    type Latent = ();

    fn ln_density(&self, point: &Vector3<f64>, (): &()) -> Option<(f64, ())> {
        let off = point - self.mean;
        Some((-0.5 * off.dot(&(self.precision * off)), ()))
    }
}

/// y ~ N(0, 1) and x | y ~ N(0.3 (y² − 1), 0.5²), in the half plane where y is below a bound: a bent ridge with an edge.
struct Banana {
    bound: f64,
}

impl LogDensity<2> for Banana {
    type Latent = ();

    fn ln_density(&self, point: &SVector<f64, 2>, (): &()) -> Option<(f64, ())> {
        let (x, y) = (point[0], point[1]);
        let off = (x - 0.3 * (y * y - 1.0)) / 0.5;
        (y < self.bound).then_some((-0.5 * (y * y + off * off), ()))
    }
}

fn draws<const D: usize, T: LogDensity<D, Latent = ()>>(density: &T, seed: u64) -> Draws<D> {
    let draws = sample(density, Student::standard(), &(), &EFFORT, &mut stream(seed, 0)).unwrap();
    assert!(draws.converged);
    draws
}

#[track_caller]
fn assert_near(found: Diagnosis, expected: f64) {
    let (difference, error) = (found.mean - expected, found.standard_error());
    assert!(difference.abs() < ERRORS * error, "{} ± {error} instead of {expected}", found.mean);
}

#[test]
fn a_normal_distribution_is_recovered() {
    let root = Matrix3::new(10.0, 0.0, 0.0, 0.9, 0.3, 0.0, -0.08, 0.05, 0.03);
    let covariance = root * root.transpose();
    let mean = Vector3::new(3.0, -1.0, 0.5);
    let draws = draws(&Normal { mean, precision: covariance.try_inverse().unwrap() }, 1);
    for i in 0..3 {
        assert_near(draws.diagnose(|x| x[i]), mean[i]);
        for j in 0..=i {
            assert_near(draws.diagnose(|x| (x[i] - mean[i]) * (x[j] - mean[j])), covariance[(i, j)]);
        }
    }
}

#[test]
fn a_bent_ridge_is_recovered() {
    let draws = draws(&Banana { bound: f64::INFINITY }, 2);
    assert_near(draws.diagnose(|x| x[0]), 0.0);
    assert_near(draws.diagnose(|x| x[0] * x[0]), 0.43);
    assert_near(draws.diagnose(|x| x[1]), 0.0);
    assert_near(draws.diagnose(|x| x[1] * x[1]), 1.0);
}

#[test]
fn an_edge_is_kept() {
    // y | y < 0 is half-normal: its mean is −√(2/π), that of y² is 1.
    let draws = draws(&Banana { bound: 0.0 }, 3);
    assert_near(draws.diagnose(|x| x[1]), -(2.0 / std::f64::consts::PI).sqrt());
    assert_near(draws.diagnose(|x| x[0]), 0.0);
}

#[test]
fn the_effective_size_is_that_of_an_autoregressive_chain() {
    let correlation: f64 = 0.8;
    let length = 5000;
    let chains: Vec<Vec<f64>> = (0..8)
        .map(|chain| {
            let mut random = stream(5, chain);
            let mut state: f64 = StandardNormal.sample(&mut random);
            let mut next = || {
                let innovation: f64 = StandardNormal.sample(&mut random);
                state = correlation * state + (1.0 - correlation * correlation).sqrt() * innovation;
                state
            };
            (0..length).map(|_| next()).collect()
        })
        .collect();
    let found = Diagnosis::of(&chains);
    let draws = (8 * length) as f64;
    let expected = draws * (1.0 - correlation) / (1.0 + correlation);
    // Relative standard error of a windowed autocorrelation time over W lags: √(2 (2W + 1) / N), here W ≈ 5 times.
    let window = 5.0 * (1.0 + correlation) / (1.0 - correlation);
    let error = (2.0 * (2.0 * window + 1.0) / draws).sqrt();
    assert!((found.effective_size / expected - 1.0).abs() < ERRORS * error, "{} not {expected}", found.effective_size);
    assert!((found.std - 1.0).abs() < ERRORS / (2.0 * expected).sqrt(), "{}", found.std);
    assert!(found.split_r_hat < 1.0 + ERRORS * 16.0 / expected, "{}", found.split_r_hat);
}

#[test]
fn chains_that_disagree_are_told() {
    // Two chains of unit variance whose means are two apart: the variance of four halves' means is 4/3, so R̂ = √(7/3).
    let chains: Vec<Vec<f64>> = [-1.0, 1.0]
        .into_iter()
        .enumerate()
        .map(|(place, mean)| {
            let mut random = stream(6, place);
            (0..20_000).map(|_| mean + Distribution::<f64>::sample(&StandardNormal, &mut random)).collect()
        })
        .collect();
    let found = Diagnosis::of(&chains);
    assert!((found.split_r_hat - (7.0_f64 / 3.0).sqrt()).abs() < ERRORS / (2.0 * 20_000.0_f64).sqrt());
    assert!(found.effective_size < 10.0, "{}", found.effective_size);
}

/// A function of two variables that goes through every operation that has a derivative of its own.
fn woven<S: Scalar>(x: S, y: S) -> S {
    let (sin, cos) = (x * y).sin_cos();
    let mut sum = sin / (cos + S::constant(3.0)) - x.exp() * y.ln();
    sum += (x / (x + y)).acos().sqrt();
    sum -= y.powf(x) * (-(x - y)).abs();
    sum
}

#[test]
fn dual_numbers_carry_the_slopes() {
    let (x, y): (f64, f64) = (0.7, 1.3);
    let found = woven(Dual::<f64, 2>::variable(x, 0), Dual::variable(y, 1));
    let step = 1e-5;
    let by_x = (woven(x + step, y) - woven(x - step, y)) / (2.0 * step);
    let by_y = (woven(x, y + step) - woven(x, y - step)) / (2.0 * step);
    assert!((found.value - woven(x, y)).abs() < 1e-14);
    // Central differences err by step²/6 of the third derivative, which is of order ten here.
    assert!((found.slopes[0] - by_x).abs() < 1e-8 && (found.slopes[1] - by_y).abs() < 1e-8);
}
