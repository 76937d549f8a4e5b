//! The per-wheel network on blocks of examples.

use kapvik_firmware::network::{OUTPUTS, WHEEL_HIDDEN, WHEEL_INPUTS};
use pulp::Simd;

use super::example::{Example, WheelInput};
use super::lanes::{Lane, ZERO, add_input_slope, add_layer_gradient, apply_layer, before_activation, run_layer};
use super::trainable::{Trainable, in_lanes, layer_fan_in};
use super::wheel_weights::WheelWeights;

/// What the neurons put out.
pub struct WheelBlock {
    input: [Lane; WHEEL_INPUTS],
    first: [Lane; WHEEL_HIDDEN],
    second: [Lane; WHEEL_HIDDEN],
    output: [Lane; OUTPUTS],
}

impl Trainable for WheelWeights {
    type Input = WheelInput;
    type Block = WheelBlock;

    fn zero() -> Self {
        Self::ZERO
    }
    fn fan_in() -> Self {
        Self {
            first: layer_fan_in(WHEEL_INPUTS),
            second: layer_fan_in(WHEEL_HIDDEN),
            output: layer_fan_in(WHEEL_HIDDEN),
        }
    }
    fn matrices() -> Vec<[usize; 2]> {
        vec![[WHEEL_INPUTS + 1, WHEEL_HIDDEN], [WHEEL_HIDDEN + 1, WHEEL_HIDDEN], [WHEEL_HIDDEN + 1, OUTPUTS]]
    }

    #[inline(always)]
    fn run_block<S: Simd>(&self, simd: S, examples: &[Example<WheelInput>]) -> WheelBlock {
        let input = in_lanes(examples.iter().map(|example| &example.input));
        let (mut first, mut second, mut output) = ([ZERO; WHEEL_HIDDEN], [ZERO; WHEEL_HIDDEN], [ZERO; OUTPUTS]);
        run_layer(simd, &self.first, &input, &mut first);
        run_layer(simd, &self.second, &first, &mut second);
        apply_layer(simd, &self.output, &second, &mut output);
        WheelBlock { input, first, second, output }
    }
    fn outputs(block: &WheelBlock) -> &[Lane; OUTPUTS] {
        &block.output
    }

    #[inline(always)]
    fn backward<S: Simd>(&self, simd: S, block: &WheelBlock, slope: &[Lane; OUTPUTS], gradient: &mut Self) {
        add_layer_gradient(simd, &block.second, slope, &mut gradient.output);
        let mut second = [ZERO; WHEEL_HIDDEN];
        add_input_slope(simd, &self.output.weights, slope, &mut second);
        before_activation(&mut second, &block.second);
        add_layer_gradient(simd, &block.first, &second, &mut gradient.second);
        let mut first = [ZERO; WHEEL_HIDDEN];
        add_input_slope(simd, &self.second.weights, &second, &mut first);
        before_activation(&mut first, &block.first);
        add_layer_gradient(simd, &block.input, &first, &mut gradient.first);
    }
}
