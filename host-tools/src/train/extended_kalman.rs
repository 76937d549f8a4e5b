//! Training by an extended Kalman filter (Singhal & Wu 1988; Ruck et al. 1992, the seed's reference 8): the weights are the
//! state, each example is a measurement of the outputs.

use kapvik_firmware::network::OUTPUTS;
use nalgebra::{DMatrix, DVector, SMatrix, SVector};

use super::example::Example;
use super::loss::{fisher, gaussian};
use super::trainable::{Linearised, Trainable, change_each, linearised, parameter_count};

/// The filter: covariance of the weights and its growth from example to example.
pub struct ExtendedKalman {
    covariance: DMatrix<f64>,
    /// Process noise of each weight per example.
    process_noise: f64,
}

impl ExtendedKalman {
    /// Initial variance of each weight.
    const INITIAL_VARIANCE: f64 = 0.1;
    /// An innovation of more than this many of its standard deviations is cut to it.
    const GREATEST_INNOVATION: f64 = 3.0;

    /// For a network of that shape.
    pub fn new<N: Trainable>(network: &N) -> Self {
        let count = parameter_count(network);
        Self { covariance: DMatrix::identity(count, count) * Self::INITIAL_VARIANCE, process_noise: 1e-9 }
    }

    /// Presents one example.
    pub fn step<N: Trainable>(&mut self, network: &mut N, example: &Example<N::Input>) {
        let Linearised { outputs, jacobian } = linearised(network, example);
        let (_, slope) = gaussian(&outputs, &example.target);
        let noise = fisher(&outputs).map(|information| 1.0 / f64::from(information));
        let count = parameter_count(network);
        let h = DMatrix::from_fn(OUTPUTS, count, |k, i| f64::from(jacobian[k][i]));
        let gain_base = &self.covariance * h.transpose();
        let mut innovation_covariance: SMatrix<f64, OUTPUTS, OUTPUTS> = (&h * &gain_base).fixed_resize(0.0);
        let mut innovation = SVector::<f64, OUTPUTS>::zeros();
        for k in 0..OUTPUTS {
            innovation_covariance[(k, k)] += noise[k];
            let bound = Self::GREATEST_INNOVATION * innovation_covariance[(k, k)].sqrt();
            innovation[k] = (-f64::from(slope[k]) * noise[k]).clamp(-bound, bound);
        }
        let Some(factor) = innovation_covariance.cholesky() else { return };
        let change: DVector<f64> = &gain_base * factor.solve(&innovation);
        let whitened =
            factor.l().solve_lower_triangular(&gain_base.transpose()).unwrap_or_else(|| DMatrix::zeros(OUTPUTS, count));
        self.covariance.gemm_tr(-1.0, &whitened, &whitened, 1.0);
        (0..count).for_each(|k| self.covariance[(k, k)] += self.process_noise);
        change_each(network, &change, |weight, c| *weight = (f64::from(*weight) + c) as f32);
    }
}
