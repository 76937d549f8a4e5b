//! Levenberg–Marquardt on the Gaussian likelihood: the Gauss–Newton matrix is that of Fisher's information, in which a
//! predicted mean counts with its precision and a predicted log-variance with one half.

use kapvik_firmware::network::OUTPUTS;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::back_propagation::mean_loss;
use super::example::Example;
use super::loss::{fisher, gaussian};
use super::rank_update::RankUpdate;
use super::trainable::{Trainable, change_each, flatten, output_jacobian, parameter_count};

/// Parts of the set that are summed by themselves, so that the result does not depend on the number of cores.
const PARTS: usize = 8;
/// Damping is given up at this value: no step that lowers the loss was found.
const GREATEST_DAMPING: f64 = 1e6;

/// State of the method: the damping μ, lowered tenfold on success and raised tenfold on failure.
pub struct LevenbergMarquardt {
    damping: f64,
    /// Weight decay per example, in units of the mean loss.
    decay: f64,
}

impl Default for LevenbergMarquardt {
    fn default() -> Self {
        Self { damping: 1e-2, decay: 1e-6 }
    }
}

impl LevenbergMarquardt {
    /// One accepted step on the whole set; returns whether one was found.
    pub fn step<N: Trainable>(&mut self, network: &mut N, set: &[Example<N::Input>]) -> bool {
        let weights = DVector::from_iterator(parameter_count(network), flatten(network).into_iter().map(f64::from));
        let penalty = |w: &DVector<f64>| 0.5 * self.decay * w.norm_squared();
        let before = mean_loss(network, set) + penalty(&weights);
        let (matrix, mut slope) = normal_equations(network, set);
        slope += self.decay * &weights;
        while self.damping <= GREATEST_DAMPING {
            let mut damped = matrix.clone();
            (0..weights.len()).for_each(|k| damped[(k, k)] += self.decay + self.damping);
            if let Some(factor) = damped.cholesky() {
                let candidate = &weights - factor.solve(&slope);
                let mut trial = network.clone();
                change_each(&mut trial, &candidate, |weight, &new| *weight = new as f32);
                if mean_loss(&trial, set) + penalty(&candidate) < before {
                    *network = trial;
                    self.damping = (self.damping * 0.1).max(1e-9);
                    return true;
                }
            }
            self.damping *= 10.0;
        }
        false
    }
}

/// Mean of JᵀFJ and of the loss's slope over the set.
fn normal_equations<N: Trainable>(network: &N, set: &[Example<N::Input>]) -> (DMatrix<f64>, DVector<f64>) {
    let count = parameter_count(network);
    let parts: Vec<(Vec<f64>, Vec<f64>)> = set
        .par_chunks(set.len().div_ceil(PARTS).max(1))
        .map(|part| {
            let mut update = RankUpdate::new(count);
            let mut slope = vec![0.0_f64; count];
            for example in part {
                let run = network.run(&example.input);
                let outputs = N::outputs(&run);
                let (_, loss_slope) = gaussian(outputs, &example.target);
                let information = fisher(outputs);
                let jacobian: [Vec<f32>; OUTPUTS] = output_jacobian(network, &example.input, &run);
                for ((row, s), f) in jacobian.iter().zip(loss_slope).zip(information) {
                    update.add(row, f.sqrt());
                    slope.iter_mut().zip(row).for_each(|(sum, x)| *sum += f64::from(s * x));
                }
            }
            (update.finish(), slope)
        })
        .collect();
    let share = 1.0 / set.len() as f64;
    let mut matrix = DMatrix::zeros(count, count);
    let mut slope = DVector::zeros(count);
    for (part_matrix, part_slope) in parts {
        matrix += share * DMatrix::from_vec(count, count, part_matrix);
        slope += share * DVector::from_vec(part_slope);
    }
    (matrix, slope)
}
