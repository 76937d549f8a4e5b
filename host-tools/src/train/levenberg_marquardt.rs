//! Levenberg–Marquardt on the Gaussian likelihood: the Gauss–Newton matrix is that of Fisher's information, in which a
//! predicted mean counts with its precision and a predicted log-variance with one half.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::back_propagation::mean_loss;
use super::example::Example;
use super::loss::{fisher, gaussian};
use super::rank_update::RankUpdate;
use super::trainable::{Linearised, Trainable, change_each, flatten, linearised, parameter_count};

/// Parts of the set that are summed by themselves, so that the result does not depend on the number of cores.
const PARTS: usize = 8;
/// Damping is given up at this value: no step that lowers the loss was found.
const GREATEST_DAMPING: f64 = 1e6;

/// The damping μ, lowered tenfold on success and raised tenfold on failure.
pub(super) struct Damping(f64);

impl Default for Damping {
    fn default() -> Self {
        Self(1e-2)
    }
}

impl Damping {
    /// Where (`matrix` + μ) δ = `slope` leads from `weights`, with the least μ tried that gets `loss` below `before`; none
    /// where none does.
    pub fn descend(
        &mut self,
        weights: &DVector<f64>,
        matrix: &DMatrix<f64>,
        slope: &DVector<f64>,
        before: f64,
        mut loss: impl FnMut(&DVector<f64>) -> f64,
    ) -> Option<DVector<f64>> {
        while self.0 <= GREATEST_DAMPING {
            let mut damped = matrix.clone();
            (0..weights.len()).for_each(|k| damped[(k, k)] += self.0);
            if let Some(factor) = damped.cholesky() {
                let candidate = weights - factor.solve(slope);
                if loss(&candidate) < before {
                    self.0 = (self.0 * 0.1).max(1e-9);
                    return Some(candidate);
                }
            }
            self.0 *= 10.0;
        }
        None
    }
}

/// State of the method.
pub struct LevenbergMarquardt {
    damping: Damping,
    /// Weight decay per example, in units of the mean loss.
    decay: f64,
}

impl Default for LevenbergMarquardt {
    fn default() -> Self {
        Self { damping: Damping::default(), decay: 1e-6 }
    }
}

impl LevenbergMarquardt {
    /// One accepted step on the whole set; returns whether one was found.
    pub fn step<N: Trainable>(&mut self, network: &mut N, set: &[Example<N::Input>]) -> bool {
        let weights = DVector::from_iterator(parameter_count(network), flatten(network).into_iter().map(f64::from));
        let penalty = |w: &DVector<f64>| 0.5 * self.decay * w.norm_squared();
        let before = mean_loss(network, set) + penalty(&weights);
        let (mut matrix, mut slope) = normal_equations(network, set);
        slope += self.decay * &weights;
        (0..weights.len()).for_each(|k| matrix[(k, k)] += self.decay);
        let mut trial = network.clone();
        let found = self.damping.descend(&weights, &matrix, &slope, before, |candidate| {
            change_each(&mut trial, candidate, |weight, &new| *weight = new as f32);
            mean_loss(&trial, set) + penalty(candidate)
        });
        if found.is_some() {
            *network = trial;
        }
        found.is_some()
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
                let Linearised { outputs, jacobian } = linearised(network, example);
                let (_, loss_slope) = gaussian(&outputs, &example.target);
                let information = fisher(&outputs);
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
