//! Inputs of like size for the trainer, though not for the network that flies.

use kapvik_firmware::estimator::doubt::INPUTS;

use super::rows::SideRows;
use super::weights::DoubtWeights;

/// An input that varies less than this tells nothing: flight takes inputs to 1/4096.
const LEAST_STD: f64 = 1.0e-3;

/// Means and standard deviations of the inputs over some rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standard {
    /// Means.
    pub mean: [f32; INPUTS],
    /// One over the standard deviation; zero where an input does not vary.
    per_std: [f32; INPUTS],
}

impl Standard {
    /// Of the rows of these sides.
    pub fn of(sides: &[SideRows]) -> Self {
        let count = sides.iter().map(Vec::len).sum::<usize>().max(1) as f64;
        let mut standard = Self { mean: [0.0; INPUTS], per_std: [0.0; INPUTS] };
        for (place, (mean, per_std)) in standard.mean.iter_mut().zip(&mut standard.per_std).enumerate() {
            let values = sides.iter().flatten().map(|row| f64::from(row.inputs[place]));
            let mean_value = values.clone().sum::<f64>() / count;
            let variance = values.map(|value| (value - mean_value).powi(2)).sum::<f64>() / count;
            *mean = mean_value as f32;
            *per_std = if variance > LEAST_STD * LEAST_STD { (1.0 / variance.sqrt()) as f32 } else { 0.0 };
        }
        standard
    }

    /// Inputs less their mean, over their standard deviation.
    pub fn apply(&self, inputs: &mut [f32; INPUTS]) {
        for (input, (mean, per_std)) in inputs.iter_mut().zip(self.mean.iter().zip(&self.per_std)) {
            *input = (*input - mean) * per_std;
        }
    }

    /// The network that does with inputs as they are what `weights` does with those that [`Self::apply`] makes.
    pub fn folded_into(&self, weights: &DoubtWeights) -> DoubtWeights {
        let mut folded = weights.clone();
        let mut bias = weights.first.bias.map(f64::from);
        for (row, (mean, per_std)) in folded.first.weights.0.iter_mut().zip(self.mean.iter().zip(&self.per_std)) {
            for (weight, bias) in row.iter_mut().zip(&mut bias) {
                *weight *= per_std;
                *bias -= f64::from(*weight) * f64::from(*mean);
            }
        }
        folded.first.bias = bias.map(|bias| bias as f32);
        folded
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::doubt::pass::outputs_of;
    use crate::doubt::rows::Row;

    #[test]
    fn folded_weights_do_the_same() {
        let inputs = |seed: usize| std::array::from_fn(|k| 0.3 * k as f32 - 4.0 + libm::sinf((seed * 41 + k) as f32));
        let mut rows: SideRows = (0..50).map(|seed| Row { inputs: inputs(seed), known: None }).collect();
        rows.iter_mut().for_each(|row| row.inputs[3] = 2.5);
        let standard = Standard::of(std::slice::from_ref(&rows));
        let mut weights = DoubtWeights::initial(5);
        weights.output.weights.0.as_flattened_mut().fill(0.1);
        let folded = outputs_of(&standard.folded_into(&weights), &rows);
        rows.iter_mut().for_each(|row| standard.apply(&mut row.inputs));
        assert!(rows.iter().all(|row| row.inputs[3] == 0.0), "an input that does not vary tells nothing");
        for (one, other) in outputs_of(&weights, &rows).iter().zip(&folded) {
            assert!(one.iter().zip(other).all(|(one, other)| (one - other).abs() < 2e-4), "{one:?}, {other:?}");
        }
    }
}
