//! On a linear problem a sigma-point filter is the Kalman filter. Here that is written in the textbook's covariance form.

use kapvik_firmware::filter::{Fate, Fusion, Gate, Gaussian, Prediction, SigmaPointFilter};
use nalgebra::{SMatrix, SVector};

const N: usize = 4;
const M: usize = 3;

/// Two positions and their speeds, coupled a little.
const TRANSITION: [[f64; N]; N] =
    [[1.0, 0.1, 0.0, 0.0], [-0.2, 0.95, 0.05, 0.0], [0.0, 0.0, 1.0, 0.1], [0.1, 0.0, -0.3, 0.9]];
const OBSERVATION: [[f64; N]; M] = [[1.0, 0.0, 0.0, 0.0], [0.3, 0.0, 1.0, 0.2], [0.0, 1.0, 0.0, -1.0]];
const PROCESS_STD: [f64; N] = [0.01, 0.1, 0.0, 0.2];
const NOISE_STD: [f64; M] = [0.05, 0.3, 0.02];
const START: [f64; N] = [1.0, -0.5, 0.2, 0.0];
const START_STD: [f64; N] = [1.0, 2.0, 0.5, 3.0];

/// The Kalman filter, by covariances.
struct Kalman {
    mean: SVector<f64, N>,
    covariance: SMatrix<f64, N, N>,
}

impl Kalman {
    fn start() -> Self {
        let covariance = SMatrix::from_diagonal(&SVector::from(START_STD.map(|std| std * std)));
        Self { mean: SVector::from(START), covariance }
    }

    fn predict(&mut self) {
        let noise = SMatrix::from_diagonal(&SVector::from(PROCESS_STD.map(|std| std * std)));
        let transition = matrix(&TRANSITION);
        self.mean = transition * self.mean;
        self.covariance = transition * self.covariance * transition.transpose() + noise;
    }

    /// Gives νᵀ S⁻¹ ν.
    fn update(&mut self, measured: SVector<f64, M>) -> f64 {
        let noise = SMatrix::from_diagonal(&SVector::from(NOISE_STD.map(|std| std * std)));
        let observation = matrix(&OBSERVATION);
        let innovation = measured - observation * self.mean;
        let spread = observation * self.covariance * observation.transpose() + noise;
        let inverse = spread.try_inverse().expect("the noise is positive");
        let gain = self.covariance * observation.transpose() * inverse;
        self.mean += gain * innovation;
        self.covariance -= gain * spread * gain.transpose();
        (innovation.transpose() * inverse * innovation)[(0, 0)]
    }
}

fn matrix<const A: usize, const B: usize>(rows: &[[f64; B]; A]) -> SMatrix<f64, A, B> {
    SMatrix::from_fn(|row, column| rows[row][column])
}

fn apply<const A: usize, const B: usize>(rows: &[[f64; B]; A], x: &[f64; B]) -> [f64; A] {
    (matrix(rows) * SVector::from(*x)).into()
}

#[test]
fn equals_the_kalman_filter() {
    let mut kalman = Kalman::start();
    let start = Gaussian::independent(START, START_STD).expect("numbers");
    let mut filter = SigmaPointFilter::new(start, START_STD).expect("numbers");
    for step in 0..200 {
        let t = f64::from(step);
        let measured = [1.0 + (0.3 * t).sin(), (0.7 * t).cos(), 0.5 * (0.2 * t).sin()];
        kalman.predict();
        assert_eq!(filter.predict(|x| apply(&TRANSITION, x), &PROCESS_STD), Prediction::Done);
        let expected = kalman.update(SVector::from(measured));
        let told = filter.update(|x| apply(&OBSERVATION, x), &measured.map(Some), &NOISE_STD, Gate::Open);
        assert_eq!((told.fusion, told.degrees_of_freedom), (Fusion::Done, M));
        assert!(told.residuals.iter().all(|residual| residual.fate == Fate::Used));
        assert!((told.normalised_square - expected).abs() < 1e-9 * (1.0 + expected), "{told:?}, {expected}");
        for i in 0..N {
            assert!((filter.estimate().mean()[i] - kalman.mean[i]).abs() < 1e-10, "step {step}, state {i}");
            for j in 0..N {
                let covariance = filter.estimate().covariance(i, j).expect("two states");
                assert!((covariance - kalman.covariance[(i, j)]).abs() < 1e-11, "step {step}, states {i} {j}");
            }
        }
    }
}

#[test]
fn a_weighted_sum_has_the_variance_that_the_covariance_gives() {
    let start = Gaussian::independent(START, START_STD).expect("numbers");
    let mut filter = SigmaPointFilter::new(start, START_STD).expect("numbers");
    assert_eq!(filter.predict(|x| apply(&TRANSITION, x), &PROCESS_STD), Prediction::Done);
    let estimate = filter.estimate();
    let weights = SVector::from([1.0, -2.0, 0.5, 3.0]);
    let covariance = SMatrix::<f64, N, N>::from_fn(|i, j| estimate.covariance(i, j).expect("two states"));
    let (mean, variance) = estimate.weighted_sum(&weights.into());
    assert!((mean - weights.dot(&SVector::from(*estimate.mean()))).abs() < 1e-12);
    assert!((variance - (weights.transpose() * covariance * weights)[(0, 0)]).abs() < 1e-12 * variance);
}
