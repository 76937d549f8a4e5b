//! The crate kfilter.

use kapvik_firmware::filter::trial::{self, Scales};
use kfilter::measurement::Measurement;
use kfilter::system::{NoInputSystem, System};
use kfilter::ukf::{UKFParameters, UnscentedKalman};
use kfilter::{KalmanFilter, KalmanPredict, KalmanUpdate};
use nalgebra::{SMatrix, SVector};

use crate::contender::{ALPHA, Answer, BETA, Contender, KAPPA, process};

/// `X` is 2 `N` + 1.
pub struct Kfilter<const N: usize, const M: usize, const X: usize, const DRIFT: bool> {
    filter: UnscentedKalman<f32, N, 0, X, Ring<N, DRIFT>>,
    sensors: Sensors<M>,
}

struct Ring<const N: usize, const DRIFT: bool> {
    state: SVector<f32, N>,
    noise: SMatrix<f32, N, N>,
}

impl<const N: usize, const DRIFT: bool> System<f32, N, 0> for Ring<N, DRIFT> {
    fn covariance(&self) -> &SMatrix<f32, N, N> {
        &self.noise
    }
    fn state(&self) -> &SVector<f32, N> {
        &self.state
    }
    fn state_mut(&mut self) -> &mut SVector<f32, N> {
        &mut self.state
    }
}

impl<const N: usize, const DRIFT: bool> NoInputSystem<f32, N> for Ring<N, DRIFT> {
    fn predict(&self, x: &SVector<f32, N>) -> SVector<f32, N> {
        process::<f32, N, DRIFT>(|value| value as f32, &x.data.0[0]).into()
    }
}

struct Sensors<const M: usize> {
    measured: SVector<f32, M>,
    noise: SMatrix<f32, M, M>,
}

impl<const N: usize, const M: usize> Measurement<f32, N, M> for Sensors<M> {
    fn predict(&self, x: &SVector<f32, N>) -> SVector<f32, M> {
        trial::measurement(&x.data.0[0]).into()
    }
    fn measurement(&self) -> &SVector<f32, M> {
        &self.measured
    }
    fn covariance(&self) -> &SMatrix<f32, M, M> {
        &self.noise
    }
    fn set_measurement(&mut self, z: SVector<f32, M>) {
        self.measured = z;
    }
}

impl<const N: usize, const M: usize, const X: usize, const DRIFT: bool> Contender<N, M> for Kfilter<N, M, X, DRIFT> {
    fn start(scales: &Scales) -> Self {
        let diagonal = |std: f32| SMatrix::<f32, N, N>::identity() * (std * std);
        let ring = Ring { state: SVector::zeros(), noise: diagonal(scales.process_std) };
        let spread = UKFParameters { alpha: ALPHA, beta: BETA, kappa: KAPPA };
        let noise = SMatrix::identity() * (scales.noise_std * scales.noise_std);
        Self {
            filter: UnscentedKalman::new_custom_with_params(ring, diagonal(scales.start_std), spread),
            sensors: Sensors { measured: SVector::zeros(), noise },
        }
    }

    #[inline]
    fn step(&mut self, measured: Option<&[f32; M]>) -> Answer<N> {
        let mut failed = self.filter.predict().is_err();
        if let Some(measured) = measured {
            self.sensors.measured = (*measured).into();
            failed |= self.filter.update(&self.sensors).is_err();
        }
        Answer { mean: self.filter.state().data.0[0], told: failed, failed }
    }
}
