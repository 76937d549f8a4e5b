//! How far estimates are from the truth over many cases, and how far from the limit.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::statistics::{Measured, median, root_mean_square};

use super::coordinates::Targets;

/// Resamplings of the cases for a standard error (B. Efron's bootstrap).
const RESAMPLINGS: usize = 2000;

/// Estimates less truth, case by case.
#[derive(Debug, Clone, PartialEq)]
pub struct Errors(Vec<Targets>);

impl Errors {
    /// From estimates and truths of the same cases.
    pub fn new(pairs: impl Iterator<Item = (Targets, Targets)>) -> Self {
        Self(pairs.map(|(estimate, truth)| std::array::from_fn(|k| estimate[k] - truth[k])).collect())
    }

    /// Root mean square error of one target.
    pub fn rmse(&self, target: usize) -> Measured {
        measured(self.0.len(), |cases| rmse(&self.0, target, cases))
    }

    /// Median of |e^error − 1|: the relative error of a target that is a logarithm.
    pub fn median_relative(&self, target: usize) -> f64 {
        median(self.0.iter().map(|error| libm::expm1(error[target]).abs()))
    }

    /// Root mean square error of one target over that of `limit` on the same cases.
    pub fn ratio(&self, limit: &Self, target: usize) -> Measured {
        measured(self.0.len(), |cases| rmse(&self.0, target, cases.clone()) / rmse(&limit.0, target, cases))
    }
}

fn rmse(errors: &[Targets], target: usize, cases: impl Iterator<Item = usize>) -> f64 {
    root_mean_square(cases.filter_map(|case| errors.get(case)).map(|error| error[target]))
}

/// A statistic of some cases, and its standard deviation over resampled cases.
fn measured(count: usize, statistic: impl Fn(std::vec::IntoIter<usize>) -> f64) -> Measured {
    let mut random = ChaCha8Rng::seed_from_u64(0);
    let mut resampled = || (0..count).map(|_| random.random_range(0..count)).collect::<Vec<_>>().into_iter();
    let values: Vec<f64> = (0..RESAMPLINGS).map(|_| statistic(resampled())).collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let squares = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>();
    let value = statistic((0..count).collect::<Vec<_>>().into_iter());
    Measured { value, standard_error: libm::sqrt(squares / (values.len() as f64 - 1.0)) }
}
