//! Levenberg–Marquardt on the mean square error, stopped where the error on examples set aside rises.

use nalgebra::{DMatrix, DVector};

use super::super::levenberg_marquardt::Damping;
use super::examples::{Example, Scale, draw, target_scale};
use super::network::{Network, WEIGHTS};
use super::{CrossNetwork, INPUTS, Scope, TARGETS};

/// Examples that are drawn.
const EXAMPLES: usize = 8000;
/// Steps at most.
const MOST_STEPS: usize = 100;
/// Steps in a row without a better network on the examples to stop by, after which it ends.
const PATIENCE: usize = 6;

/// A trained network, and how well it did.
#[derive(Debug, Clone, PartialEq)]
pub struct Trained {
    /// The network.
    pub network: CrossNetwork,
    /// Errors on the examples that took no part in training.
    pub held_out: HeldOut,
    /// Steps that were taken.
    pub steps: usize,
}

/// Errors on noise-free examples that took no part in training.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeldOut {
    /// Examples.
    pub count: usize,
    /// Root mean square error of ln c, φ (rad) and ln K.
    pub error: [f64; TARGETS],
    /// One minus the error's square over the variance of ln c, φ and ln K among the examples.
    pub determination: [f64; TARGETS],
}

/// An example on the network's scale.
struct Scaled {
    input: [f64; INPUTS],
    target: [f64; TARGETS],
}

/// Trains a network; the same scope and seed give the same one. Takes a few seconds.
pub fn train(scope: &Scope, seed: u64) -> Trained {
    let examples = draw(scope, EXAMPLES, seed);
    let (learnt, rest) = examples.split_at(examples.len() * 70 / 100);
    let (watched, tested) = rest.split_at(rest.len() / 2);
    let (inputs, targets) = (Scale::of(learnt.iter().map(|example| example.input)), target_scale());
    let scaled = |examples: &[Example]| -> Vec<Scaled> {
        let scale =
            |example: &Example| Scaled { input: inputs.apply(&example.input), target: targets.apply(&example.target) };
        examples.iter().map(scale).collect()
    };
    let (network, steps) = descend(Network::initial(seed), &scaled(learnt), &scaled(watched));
    let held_out = held_out(&network, &scaled(tested), &targets);
    Trained { network: CrossNetwork { inputs, targets, network, error: held_out.error }, held_out, steps }
}

/// The network that was best on `watched` on the way down on `learnt`, and the steps taken.
fn descend(start: Network, learnt: &[Scaled], watched: &[Scaled]) -> (Network, usize) {
    let mut weights = start.weights();
    let mut best = (mean_square(&start, watched), start);
    let (mut damping, mut since_best, mut steps) = (Damping::default(), 0, 0);
    while steps < MOST_STEPS && since_best < PATIENCE {
        let network = Network::with_weights(&weights);
        let (matrix, slope) = normal_equations(&network, learnt);
        let loss = |weights: &DVector<f64>| mean_square(&Network::with_weights(weights), learnt);
        let Some(next) = damping.descend(&weights, &matrix, &slope, mean_square(&network, learnt), loss) else { break };
        weights = next;
        steps += 1;
        since_best += 1;
        let network = Network::with_weights(&weights);
        let error = mean_square(&network, watched);
        if error < best.0 {
            (best, since_best) = ((error, network), 0);
        }
    }
    (best.1, steps)
}

/// Half the mean over the examples of the squares of all outputs' errors.
fn mean_square(network: &Network, set: &[Scaled]) -> f64 {
    let squares = set.iter().map(|example| error(network, example).iter().map(|e| e * e).sum::<f64>());
    0.5 * squares.sum::<f64>() / set.len() as f64
}

fn error(network: &Network, example: &Scaled) -> [f64; TARGETS] {
    let output = network.run(&example.input);
    std::array::from_fn(|k| output[k] - example.target[k])
}

/// Means of JᵀJ and Jᵀe.
fn normal_equations(network: &Network, set: &[Scaled]) -> (DMatrix<f64>, DVector<f64>) {
    let mut transposed = DMatrix::zeros(WEIGHTS, TARGETS * set.len());
    let mut errors = DVector::zeros(TARGETS * set.len());
    for (place, example) in set.iter().enumerate() {
        let from = TARGETS * place;
        transposed.columns_mut(from, TARGETS).copy_from(&network.derivatives(&example.input).by_weights);
        errors.rows_mut(from, TARGETS).copy_from_slice(&error(network, example));
    }
    let share = 1.0 / set.len() as f64;
    (share * (&transposed * transposed.transpose()), share * (&transposed * errors))
}

fn held_out(network: &Network, set: &[Scaled], targets: &Scale<TARGETS>) -> HeldOut {
    let count = set.len() as f64;
    let errors: Vec<_> = set.iter().map(|example| error(network, example)).collect();
    let mean_square = |k: usize| errors.iter().map(|error| error[k] * error[k]).sum::<f64>() / count;
    let variance = |k: usize| {
        let mean = set.iter().map(|example| example.target[k]).sum::<f64>() / count;
        set.iter().map(|example| (example.target[k] - mean).powi(2)).sum::<f64>() / count
    };
    let units = targets.units();
    HeldOut {
        count: set.len(),
        error: std::array::from_fn(|k| units[k] * mean_square(k).sqrt()),
        determination: std::array::from_fn(|k| 1.0 - mean_square(k) / variance(k)),
    }
}
