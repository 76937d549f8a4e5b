//! The rover network: any one to six wheels of one instant to the soil under all of them.
//!
//! Three gated layers (Dauphin et al. 2017, "Language Modeling with Gated Convolutional Networks") and a linear one, in whole
//! numbers of 16 bits, of which the target multiplies two pairs at once and the image holds twice as many.

use super::fixed_point::{FixedLayer, Pair, Quad, SUM_BITS, gated, rounded};
use super::shape::{OUTPUTS, ROVER_FIRST, ROVER_INPUTS, ROVER_SECOND, ROVER_THIRD};
use super::words;

const INPUT_QUADS: usize = ROVER_INPUTS.div_ceil(4);
const FIRST_QUADS: usize = ROVER_FIRST / 4;
const SECOND_QUADS: usize = ROVER_SECOND / 4;
const THIRD_QUADS: usize = ROVER_THIRD / 4;
const OUTPUT_QUADS: usize = OUTPUTS.div_ceil(4);

/// A gated layer has two sums a neuron, those of all gates first: what a neuron puts out is the product of their bipolar
/// sigmoids.
#[derive(Debug, Clone, PartialEq)]
pub struct RoverNetwork {
    /// First layer.
    pub first: FixedLayer<INPUT_QUADS, { 2 * FIRST_QUADS }>,
    /// Second layer.
    pub second: FixedLayer<FIRST_QUADS, { 2 * SECOND_QUADS }>,
    /// Third layer.
    pub third: FixedLayer<SECOND_QUADS, { 2 * THIRD_QUADS }>,
    /// Linear output: means, then log-variances.
    pub output: FixedLayer<THIRD_QUADS, OUTPUT_QUADS>,
}
words!(RoverNetwork: first, second, third, output);

impl RoverNetwork {
    /// All weights zero.
    pub const ZERO: Self =
        Self { first: FixedLayer::ZERO, second: FixedLayer::ZERO, third: FixedLayer::ZERO, output: FixedLayer::ZERO };

    /// The outputs for normalised [`super::rover_inputs`], which are taken to 1/4096 and saturate at ±8.
    pub fn run(&self, inputs: &[f32; ROVER_INPUTS]) -> [f32; OUTPUTS] {
        let inputs = rounded(inputs, SUM_BITS);
        let first: [Quad; FIRST_QUADS] = neurons(&self.first.run(&inputs));
        let second: [Quad; SECOND_QUADS] = neurons(&self.second.run(&first));
        let third: [Quad; THIRD_QUADS] = neurons(&self.third.run(&second));
        self.output.outputs(&third)
    }

    /// Whether no inputs whatever can bring a sum past 32 bits, on which flight relies.
    pub fn cannot_overflow(&self) -> bool {
        self.first.cannot_overflow()
            && self.second.cannot_overflow()
            && self.third.cannot_overflow()
            && self.output.cannot_overflow()
    }
}

/// What the neurons of a gated layer put out: of its `S` = 2 `N` quads of activations the first half are gates.
fn neurons<const S: usize, const N: usize>(activations: &[Quad; S]) -> [Quad; N] {
    match (activations.first_chunk(), activations.last_chunk()) {
        (Some(gates), Some(values)) => gated(gates, values),
        _ => [[Pair::ZERO; 2]; N],
    }
}
