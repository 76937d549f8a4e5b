//! How good a network is on cases that it has not seen.

use kapvik_firmware::network::{Marginal, OUTPUTS, Posterior, PosteriorScale, RoverTable, TARGETS};
use kapvik_firmware::wheel_state::SoilQuery;
use rayon::prelude::*;

use crate::statistics::median;

use super::dataset::stream;
use super::example::{Example, targets};
use super::observe::observe;
use super::scene::Scene;
use super::trainable::{Trainable, outputs_of};

/// Errors and coverage of one target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TargetScore {
    /// Root mean square error of the posterior mean.
    pub rmse: f64,
    /// Mean error.
    pub bias: f64,
    /// Median of |e to the error − 1|: the median relative error of a target that is a logarithm.
    pub median_ratio_error: f64,
    /// Share of the truth's variance that the mean explains.
    pub r_squared: f64,
    /// Share of cases whose truth lies in the 68 % and in the 95 % interval.
    pub interval_coverage: [f64; 2],
    /// Share of cases whose truth lies within 1 and 1.96 standard deviations.
    pub std_coverage: [f64; 2],
}

/// Scores of ln c, φ, ln K.
pub type Score = [TargetScore; TARGETS];

/// Scores posteriors against true targets.
pub fn score(posteriors: &[Posterior], truths: &[[f64; TARGETS]]) -> Score {
    std::array::from_fn(|k| {
        let pairs = || posteriors.iter().zip(truths).map(|(posterior, truth)| (posterior[k], truth[k]));
        let count = posteriors.len() as f64;
        let share = |hit: &dyn Fn(f64, &Marginal) -> bool| {
            pairs().filter(|(marginal, truth)| hit(*truth, marginal)).count() as f64 / count
        };
        let errors: Vec<f64> = pairs().map(|(marginal, truth)| f64::from(marginal.mean) - truth).collect();
        let mean_square = errors.iter().map(|e| e * e).sum::<f64>() / count;
        let truth_mean = pairs().map(|(_, truth)| truth).sum::<f64>() / count;
        let truth_variance = pairs().map(|(_, truth)| (truth - truth_mean).powi(2)).sum::<f64>() / count;
        let inside = |truth: f64, [low, high]: [f32; 2]| f64::from(low) <= truth && truth <= f64::from(high);
        let within = |truth: f64, m: &Marginal, deviations: f64| {
            (truth - f64::from(m.mean)).abs() <= deviations * f64::from(m.std)
        };
        TargetScore {
            rmse: mean_square.sqrt(),
            bias: errors.iter().sum::<f64>() / count,
            median_ratio_error: median(errors.iter().map(|&e| (libm::exp(e) - 1.0).abs())),
            r_squared: 1.0 - mean_square / truth_variance,
            interval_coverage: [
                share(&|truth, m| inside(truth, m.interval_68)),
                share(&|truth, m| inside(truth, m.interval_95)),
            ],
            std_coverage: [share(&|truth, m| within(truth, m, 1.0)), share(&|truth, m| within(truth, m, 1.96))],
        }
    })
}

/// The posterior of ln c, φ, ln K that a rover network gives for a query.
pub fn rover_posterior<const PAIRS: usize>(table: &RoverTable<PAIRS>, query: &SoilQuery) -> Posterior {
    let (context, wheels) = query.rover_features();
    table.posterior.read(&table.outputs(&context, wheels))
}

/// Scores a rover network on one noisy observation of each scene, through the functions that fly.
pub fn score_rover<const PAIRS: usize>(table: &RoverTable<PAIRS>, scenes: &[Scene], seed: u32) -> Score {
    let (posteriors, truths): (Vec<Posterior>, Vec<[f64; TARGETS]>) = scenes
        .par_iter()
        .enumerate()
        .map(|(index, scene)| {
            let query = observe(scene, &mut stream(u64::from(seed), index));
            (rover_posterior(table, &query), targets(scene))
        })
        .unzip();
    score(&posteriors, &truths)
}

/// Outputs of a network on a set.
pub fn outputs<N: Trainable>(network: &N, set: &[Example<N::Input>]) -> Vec<[f32; OUTPUTS]> {
    set.par_chunks(64).flat_map_iter(|part| outputs_of(network, part)).collect()
}

/// Scores a network on a set.
pub fn score_network<N: Trainable>(network: &N, set: &[Example<N::Input>], scale: &PosteriorScale) -> Score {
    let posteriors: Vec<Posterior> = outputs(network, set).iter().map(|outputs| scale.read(outputs)).collect();
    let truths: Vec<[f64; TARGETS]> = set.iter().map(|example| truth(example, scale)).collect();
    score(&posteriors, &truths)
}

/// The targets of an example in their own units.
pub fn truth<I>(example: &Example<I>, scale: &PosteriorScale) -> [f64; TARGETS] {
    std::array::from_fn(|k| f64::from(scale.mean[k] + scale.std[k] * example.target[k]))
}
