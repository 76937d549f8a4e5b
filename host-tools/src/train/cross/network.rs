//! One hidden layer of bipolar sigmoids and a linear output.

use nalgebra::{DVector, SMatrix, SVector};
use rand::RngExt;

use super::super::dataset::stream;
use super::{INPUTS, TARGETS};

/// Neurons of the hidden layer.
const HIDDEN: usize = 10;
/// Weights of the network.
pub(super) const WEIGHTS: usize = HIDDEN * (INPUTS + 1) + TARGETS * (HIDDEN + 1);

/// The weights.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Network {
    first: SMatrix<f64, HIDDEN, INPUTS>,
    first_bias: SVector<f64, HIDDEN>,
    output: SMatrix<f64, TARGETS, HIDDEN>,
    output_bias: SVector<f64, TARGETS>,
}

/// Derivatives of the outputs.
pub(super) struct Derivatives {
    /// By the weights, in the order of [`Network::weights`].
    pub by_weights: SMatrix<f64, WEIGHTS, TARGETS>,
    /// By the inputs.
    pub by_inputs: SMatrix<f64, TARGETS, INPUTS>,
}

impl Network {
    /// Random weights by Nguyen and Widrow's rule for inputs of −1 … 1: the neurons' slopes share out the inputs' space.
    pub fn initial(seed: u64) -> Self {
        let mut random = stream(seed, 0);
        let mut draw = || 2.0 * random.random::<f64>() - 1.0;
        let length = 0.7 * (HIDDEN as f64).powf(1.0 / INPUTS as f64);
        let mut first = SMatrix::<f64, HIDDEN, INPUTS>::from_fn(|_, _| draw());
        first.row_iter_mut().for_each(|mut row| {
            let norm = row.norm();
            row *= length / norm;
        });
        let first_bias = SVector::from_fn(|k, _| {
            let place = 2.0 * k as f64 / (HIDDEN - 1) as f64 - 1.0;
            length * place * first[(k, 0)].signum()
        });
        let output = SMatrix::from_fn(|_, _| 0.5 * draw());
        Self { first, first_bias, output, output_bias: SVector::zeros() }
    }

    /// All weights in one column.
    pub fn weights(&self) -> DVector<f64> {
        let parts =
            [self.first.as_slice(), self.first_bias.as_slice(), self.output.as_slice(), self.output_bias.as_slice()];
        DVector::from_vec(parts.concat())
    }

    /// The network with these weights.
    pub fn with_weights(weights: &DVector<f64>) -> Self {
        let (first, rest) = weights.as_slice().split_at(HIDDEN * INPUTS);
        let (first_bias, rest) = rest.split_at(HIDDEN);
        let (output, output_bias) = rest.split_at(TARGETS * HIDDEN);
        Self {
            first: SMatrix::from_column_slice(first),
            first_bias: SVector::from_column_slice(first_bias),
            output: SMatrix::from_column_slice(output),
            output_bias: SVector::from_column_slice(output_bias),
        }
    }

    /// The outputs for scaled inputs.
    pub fn run(&self, input: &[f64; INPUTS]) -> [f64; TARGETS] {
        self.output_of(&self.hidden(input)).into()
    }

    /// How the outputs change.
    pub fn derivatives(&self, input: &[f64; INPUTS]) -> Derivatives {
        let hidden = self.hidden(input);
        // d tanh = 1 − tanh².
        let slope = hidden.map(|y| 1.0 - y * y);
        let mut by_weights = SMatrix::<f64, WEIGHTS, TARGETS>::zeros();
        for (target, mut column) in by_weights.column_iter_mut().enumerate() {
            for k in 0..HIDDEN {
                let back = self.output[(target, k)] * slope[k];
                input.iter().enumerate().for_each(|(i, x)| column[i * HIDDEN + k] = back * x);
                column[HIDDEN * INPUTS + k] = back;
                column[HIDDEN * (INPUTS + 1) + k * TARGETS + target] = hidden[k];
            }
            column[HIDDEN * (INPUTS + 1) + HIDDEN * TARGETS + target] = 1.0;
        }
        Derivatives { by_weights, by_inputs: self.output * SMatrix::from_diagonal(&slope) * self.first }
    }

    fn hidden(&self, input: &[f64; INPUTS]) -> SVector<f64, HIDDEN> {
        (self.first * SVector::from(*input) + self.first_bias).map(libm::tanh)
    }

    fn output_of(&self, hidden: &SVector<f64, HIDDEN>) -> SVector<f64, TARGETS> {
        self.output * hidden + self.output_bias
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_differences() {
        const STEP: f64 = 1e-6;
        let (network, input) = (Network::initial(5), [0.3, -0.8, 0.1, 0.9, -0.2]);
        let derivatives = network.derivatives(&input);
        let slope = |above: [f64; TARGETS], below: [f64; TARGETS], target: usize| {
            (above[target] - below[target]) / (2.0 * STEP)
        };
        for (weight, target) in (0..WEIGHTS).flat_map(|weight| (0..TARGETS).map(move |target| (weight, target))) {
            let moved = |step: f64| {
                let mut weights = network.weights();
                weights[weight] += step;
                Network::with_weights(&weights).run(&input)
            };
            let expected = slope(moved(STEP), moved(-STEP), target);
            assert!((derivatives.by_weights[(weight, target)] - expected).abs() < 1e-8, "weight {weight}");
        }
        for (place, target) in (0..INPUTS).flat_map(|place| (0..TARGETS).map(move |target| (place, target))) {
            let moved = |step: f64| {
                let mut input = input;
                input[place] += step;
                network.run(&input)
            };
            let expected = slope(moved(STEP), moved(-STEP), target);
            assert!((derivatives.by_inputs[(target, place)] - expected).abs() < 1e-8, "input {place}");
        }
    }
}
