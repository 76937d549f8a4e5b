//! The rover network on blocks of examples.

use kapvik_firmware::network::{OUTPUTS, ROVER_FIRST, ROVER_INPUTS, ROVER_SECOND, ROVER_THIRD};
use pulp::Simd;

use super::example::{Example, RoverInput};
use super::gated_layer::GatedLanes;
use super::lanes::{Lane, ZERO, add_input_slope, add_layer_gradient, apply_layer};
use super::rover_weights::{FIRST_SUMS, RoverWeights, SECOND_SUMS, THIRD_SUMS};
use super::trainable::{Trainable, in_lanes, layer_fan_in};

/// What the neurons put out.
pub struct RoverBlock {
    input: [Lane; ROVER_INPUTS],
    first: GatedLanes<FIRST_SUMS, ROVER_FIRST>,
    second: GatedLanes<SECOND_SUMS, ROVER_SECOND>,
    third: GatedLanes<THIRD_SUMS, ROVER_THIRD>,
    output: [Lane; OUTPUTS],
}

impl Trainable for RoverWeights {
    type Input = RoverInput;
    type Block = RoverBlock;

    fn zero() -> Self {
        Self::ZERO
    }
    fn fan_in() -> Self {
        Self {
            first: layer_fan_in(ROVER_INPUTS),
            second: layer_fan_in(ROVER_FIRST),
            third: layer_fan_in(ROVER_SECOND),
            output: layer_fan_in(ROVER_THIRD),
        }
    }
    fn matrices() -> Vec<[usize; 2]> {
        vec![
            [ROVER_INPUTS + 1, FIRST_SUMS],
            [ROVER_FIRST + 1, SECOND_SUMS],
            [ROVER_SECOND + 1, THIRD_SUMS],
            [ROVER_THIRD + 1, OUTPUTS],
        ]
    }

    #[inline(always)]
    fn run_block<S: Simd>(&self, simd: S, examples: &[Example<RoverInput>]) -> RoverBlock {
        let mut block = RoverBlock {
            input: in_lanes(examples.iter().map(|example| &example.input)),
            first: GatedLanes::ZERO,
            second: GatedLanes::ZERO,
            third: GatedLanes::ZERO,
            output: [ZERO; OUTPUTS],
        };
        block.first.run(simd, &self.first, &block.input);
        block.second.run(simd, &self.second, &block.first.outputs);
        block.third.run(simd, &self.third, &block.second.outputs);
        apply_layer(simd, &self.output, &block.third.outputs, &mut block.output);
        block
    }
    fn outputs(block: &RoverBlock) -> &[Lane; OUTPUTS] {
        &block.output
    }

    #[inline(always)]
    fn backward<S: Simd>(&self, simd: S, block: &RoverBlock, slope: &[Lane; OUTPUTS], gradient: &mut Self) {
        add_layer_gradient(simd, &block.third.outputs, slope, &mut gradient.output);
        let mut third = [ZERO; ROVER_THIRD];
        add_input_slope(simd, &self.output.weights, slope, &mut third);
        let third = block.third.before(&third);
        add_layer_gradient(simd, &block.second.outputs, &third, &mut gradient.third);
        let mut second = [ZERO; ROVER_SECOND];
        add_input_slope(simd, &self.third.weights, &third, &mut second);
        let second = block.second.before(&second);
        add_layer_gradient(simd, &block.first.outputs, &second, &mut gradient.second);
        let mut first = [ZERO; ROVER_FIRST];
        add_input_slope(simd, &self.second.weights, &second, &mut first);
        let first = block.first.before(&first);
        add_layer_gradient(simd, &block.input, &first, &mut gradient.first);
    }

    fn as_flown(&self) -> Self {
        Self::standing_for(&self.rounded())
    }

    fn bound_sums(&mut self) {
        self.bound_each_sum();
    }
}
