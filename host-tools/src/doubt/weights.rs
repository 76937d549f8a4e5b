//! The network while it is trained: the same as the flown one, in single precision.

use kapvik_firmware::estimator::doubt::{DoubtNetwork, HIDDEN, INPUTS, OUTPUTS};
use kapvik_firmware::network::fixed_point::{FixedLayer, SUM_BITS};
use kapvik_firmware::words;
use rand::RngExt;

use crate::train::dataset::stream;
use crate::train::layer::Layer;
use crate::train::rounding::{INPUT_RANGE, Scales};
use crate::train::trainable::GRADIENT;

/// The hidden layer as it flies.
type FlownFirst = FixedLayer<{ INPUTS / 4 }, { HIDDEN / 4 }>;

/// Weights of [`DoubtNetwork`] before they are rounded.
#[derive(Debug, Clone, PartialEq)]
pub struct DoubtWeights {
    /// Hidden layer.
    pub first: Layer<INPUTS, HIDDEN>,
    /// Linear output.
    pub output: Layer<HIDDEN, OUTPUTS>,
}
words!(DoubtWeights: first, output);

impl DoubtWeights {
    /// All weights zero: the filters are believed.
    pub const ZERO: Self = Self { first: Layer::ZERO, output: Layer::ZERO };

    /// Where training begins: uniform random weights of variance 1 / fan-in behind the inputs, and the filters believed.
    pub fn initial(seed: u64) -> Self {
        let mut random = stream(seed, 0);
        let mut weights = Self::ZERO;
        for weight in weights.first.weights.0.as_flattened_mut() {
            let share: f32 = random.random();
            *weight = (2.0 * share - 1.0) * (3.0 / INPUTS as f32).sqrt();
        }
        weights
    }

    /// The network as it flies, rounded to whole numbers. Inputs are far from zero, so that what rounding does to their weights would
    /// move the sums; at `mean` inputs the biases make it good.
    pub fn rounded(&self, mean: &[f32; INPUTS]) -> DoubtNetwork {
        let of_first = Scales { input_range: INPUT_RANGE, sums: |_| 0.5 * GRADIENT, cut_to: Some(SUM_BITS) };
        let flown: FlownFirst = of_first.round(&self.first);
        let flown: Layer<INPUTS, HIDDEN> = of_first.read(&flown);
        let mut first = self.first.clone();
        for ((exact, flown), mean) in self.first.weights.0.iter().zip(&flown.weights.0).zip(mean) {
            for (bias, (exact, flown)) in first.bias.iter_mut().zip(exact.iter().zip(flown)) {
                *bias += (exact - flown) * mean;
            }
        }
        DoubtNetwork {
            first: of_first.round(&first),
            output: Scales { input_range: 1.0, sums: |_| 1.0, cut_to: None }.round(&self.output),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::doubt::pass::outputs_of;
    use crate::doubt::rows::Row;
    use crate::train::rounding::tests::wave;
    use kapvik_firmware::estimator::doubt::DoubtMemory;

    /// Also where one weight is so great that it leaves the others few fraction bits, and inputs are far from zero.
    #[test]
    fn the_rounded_network_is_nearly_the_same() {
        let mut weights = DoubtWeights::initial(3);
        weights.output.weights.0.as_flattened_mut().iter_mut().enumerate().for_each(|(k, w)| *w = 0.4 * wave(k));
        weights.output.bias.iter_mut().enumerate().for_each(|(k, bias)| *bias = 0.3 * wave(50 + k));
        weights.first.weights.0[5] = [50.0; HIDDEN];
        let mean = std::array::from_fn(|k| if k == 5 { 0.02 } else { 4.0 * wave(10 + k) });
        let flown = weights.rounded(&mean);
        assert!(flown.cannot_overflow());
        let inputs = |seed: usize| {
            std::array::from_fn(|k| {
                let spread = if k == 5 { 0.02 } else { 1.0 };
                mean[k] + spread * wave(100 * seed + k)
            })
        };
        let rows: Vec<Row> = (0..400).map(|seed| Row::new(&inputs(seed))).collect();
        let mut memory = DoubtMemory::EMPTY;
        for (row, exact) in rows.iter().zip(outputs_of(&weights, &rows)) {
            for (exact, rounded) in exact.into_iter().zip(flown.run(&mut memory, &row.inputs)) {
                assert!((exact - rounded).abs() < 0.02, "{exact}, {rounded}");
            }
        }
    }
}
