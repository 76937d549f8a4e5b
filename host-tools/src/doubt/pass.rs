//! Rows through the network, and the loss's way back to its weights.

use kapvik_firmware::estimator::doubt::{HIDDEN, INPUTS, OUTPUTS};
use pulp::{Arch, Simd, WithSimd};

use super::loss::loss;
use super::rows::Row;
use super::weights::DoubtWeights;
use crate::train::lanes::{
    LANES, Lane, ZERO, add_input_slope, add_layer_gradient, apply_layer, before_activation, run_layer,
};
use crate::train::trainable::in_lanes;

/// The sum of the losses of some rows, and its slope against each weight.
#[derive(Debug, Clone)]
pub struct Slope {
    /// The sum.
    pub loss: f32,
    /// Its slope.
    pub gradient: DoubtWeights,
}

/// The sum of the losses of the rows at these places, and its slope.
pub fn slope_of(weights: &DoubtWeights, rows: &[Row], places: &[u32]) -> Slope {
    Arch::new().dispatch(Pass { weights, rows, places })
}

/// Rows to be run with registers as wide as the machine has.
struct Pass<'a> {
    weights: &'a DoubtWeights,
    rows: &'a [Row],
    places: &'a [u32],
}

impl WithSimd for Pass<'_> {
    type Output = Slope;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Slope {
        let Self { weights, rows, places } = self;
        let mut sum = Slope { loss: 0.0, gradient: DoubtWeights::ZERO };
        for places in places.chunks(LANES) {
            let rows = places.iter().filter_map(|place| rows.get(*place as usize));
            let block = Block::run(simd, weights, in_lanes(rows.clone().map(|row| &row.inputs)));
            let mut slopes = [ZERO; OUTPUTS];
            for (lane, row) in rows.enumerate() {
                let loss = loss(&block.output.map(|output| output[lane]), row);
                slopes.iter_mut().zip(loss.slope).for_each(|(lanes, slope)| lanes[lane] = slope);
                sum.loss += loss.value;
            }
            block.backward(simd, weights, &slopes, &mut sum.gradient);
        }
        sum
    }
}

/// What the neurons put out for a block of rows.
struct Block {
    input: [Lane; INPUTS],
    hidden: [Lane; HIDDEN],
    output: [Lane; OUTPUTS],
}

impl Block {
    #[inline(always)]
    fn run<S: Simd>(simd: S, weights: &DoubtWeights, input: [Lane; INPUTS]) -> Self {
        let (mut hidden, mut output) = ([ZERO; HIDDEN], [ZERO; OUTPUTS]);
        run_layer(simd, &weights.first, &input, &mut hidden);
        apply_layer(simd, &weights.output, &hidden, &mut output);
        Self { input, hidden, output }
    }

    #[inline(always)]
    fn backward<S: Simd>(&self, simd: S, weights: &DoubtWeights, slope: &[Lane; OUTPUTS], gradient: &mut DoubtWeights) {
        add_layer_gradient(simd, &self.hidden, slope, &mut gradient.output);
        let mut hidden = [ZERO; HIDDEN];
        add_input_slope(simd, &weights.output.weights, slope, &mut hidden);
        before_activation(&mut hidden, &self.hidden);
        add_layer_gradient(simd, &self.input, &hidden, &mut gradient.first);
    }
}

/// The outputs for one row's inputs.
#[cfg(test)]
pub fn outputs_of(weights: &DoubtWeights, inputs: &[f32; INPUTS]) -> [f32; OUTPUTS] {
    let block = Block::run(pulp::Scalar::new(), weights, in_lanes(std::iter::once(inputs)));
    block.output.map(|output| output[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::doubt::rows::tests::correlated;
    use crate::train::trainable::{change_each, flatten};

    fn wave(seed: usize) -> f32 {
        libm::sinf(2.399 * seed as f32)
    }

    /// More than fill a block.
    fn rows() -> Vec<Row> {
        let row = |seed: usize| Row {
            inputs: std::array::from_fn(|k| wave(100 * seed + k)),
            errors: std::array::from_fn(|k| wave(70 * seed + k)),
            wheels: correlated(),
        };
        (0..LANES + 5).map(row).collect()
    }

    #[test]
    fn gradients_are_those_of_differences() {
        const STEP: f32 = 1e-2;
        let rows = rows();
        let places: Vec<u32> = (0..rows.len() as u32).collect();
        let mut weights = DoubtWeights::initial(3);
        weights.output.weights.0.as_flattened_mut().iter_mut().enumerate().for_each(|(k, w)| *w = 0.2 * wave(k));
        let gradient = flatten(&slope_of(&weights, &rows, &places).gradient);
        let narrow = Pass { weights: &weights, rows: &rows, places: &places }.with_simd(pulp::Scalar::new());
        assert_eq!(gradient, flatten(&narrow.gradient), "other registers, other bits");
        let flat = flatten(&weights);
        for place in (0..flat.len()).step_by(23) {
            let mut at = |step: f32| {
                let moved = flat.iter().enumerate().map(|(k, w)| if k == place { w + step } else { *w });
                change_each(&mut weights, moved, |weight, value| *weight = value);
                slope_of(&weights, &rows, &places).loss
            };
            let expected = (at(STEP) - at(-STEP)) / (2.0 * STEP);
            let slope = gradient[place];
            assert!((slope - expected).abs() < 0.1 + 0.01 * expected.abs(), "{place}: {slope}, {expected}");
        }
    }
}
