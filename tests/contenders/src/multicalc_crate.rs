//! The crate multicalc.

use kapvik_firmware::filter::trial::{self, Scales};
use multicalc::estimation::UnscentedKalmanFilter;
use multicalc::linear_algebra::{Matrix, Vector};
use multicalc::scalar::{Numeric, VectorFn};

use crate::contender::{ALPHA, Answer, BETA, Contender, KAPPA, process};

pub struct Multicalc<const N: usize, const M: usize, const DRIFT: bool>(UnscentedKalmanFilter<N, M, f32>);

struct Ring<const DRIFT: bool>;

impl<const N: usize, const DRIFT: bool> VectorFn<N, N> for Ring<DRIFT> {
    fn eval<S: Numeric>(&self, x: &[S; N]) -> [S; N] {
        process::<S, N, DRIFT>(S::from_f64, x)
    }
}

struct Sensors;

impl<const N: usize, const M: usize> VectorFn<N, M> for Sensors {
    fn eval<S: Numeric>(&self, x: &[S; N]) -> [S; M] {
        trial::measurement_in(S::from_f64, x)
    }
}

fn diagonal<const A: usize>(std: f32) -> Matrix<A, A, f32> {
    Matrix::from_fn(|row, column| if row == column { std * std } else { 0.0 })
}

impl<const N: usize, const M: usize, const DRIFT: bool> Contender<N, M> for Multicalc<N, M, DRIFT> {
    fn start(scales: &Scales) -> Self {
        let filter = UnscentedKalmanFilter::new(
            Vector::new([0.0; N]),
            diagonal(scales.start_std),
            diagonal(scales.process_std),
            diagonal(scales.noise_std),
        );
        Self(filter.with_scaling(ALPHA, BETA, KAPPA).expect("the tuning is valid"))
    }

    #[inline]
    fn step(&mut self, measured: Option<&[f32; M]>) -> Answer<N> {
        let mut failed = self.0.predict(&Ring::<DRIFT>).is_err();
        if let Some(measured) = measured {
            failed |= self.0.update(&Sensors, Vector::new(*measured)).is_err();
        }
        Answer { mean: *self.0.state().as_array(), told: failed, failed }
    }
}
