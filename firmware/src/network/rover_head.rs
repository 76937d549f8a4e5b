//! What the rover network makes of the pool over its wheels: three gated layers and a linear one (gates: Dauphin et al. 2017,
//! "Language Modeling with Gated Convolutional Networks"), in whole numbers of 16 bits, of which the target multiplies two
//! pairs at once and the image holds twice as many.

use super::fixed_point::{ACTIVATION_BITS, FixedLayer, Pair, Quad, SUM_BITS, gated, rounded};
use super::shape::{
    OUTPUTS, ROVER_CONTEXT, ROVER_FIRST_HEAD, ROVER_HEAD_INPUTS, ROVER_HIDDEN, ROVER_SECOND_HEAD, ROVER_THIRD_HEAD,
};
use super::{joined, words};

const INPUT_QUADS: usize = ROVER_HEAD_INPUTS.div_ceil(4);
const FIRST_QUADS: usize = ROVER_FIRST_HEAD / 4;
const SECOND_QUADS: usize = ROVER_SECOND_HEAD / 4;
const THIRD_QUADS: usize = ROVER_THIRD_HEAD / 4;
const OUTPUT_QUADS: usize = OUTPUTS.div_ceil(4);

/// Of the head's inputs, the means and variances over the wheels, which lie within ±1.
const POOLED: usize = 2 * ROVER_HIDDEN;

/// The layers behind the pool. A gated layer has two sums a neuron, those of all gates first: what a neuron puts out is the
/// product of their bipolar sigmoids.
#[derive(Debug, Clone, PartialEq)]
pub struct RoverHead {
    /// First layer.
    pub first: FixedLayer<INPUT_QUADS, { 2 * FIRST_QUADS }>,
    /// Second layer.
    pub second: FixedLayer<FIRST_QUADS, { 2 * SECOND_QUADS }>,
    /// Third layer.
    pub third: FixedLayer<SECOND_QUADS, { 2 * THIRD_QUADS }>,
    /// Linear output: means, then log-variances.
    pub output: FixedLayer<THIRD_QUADS, OUTPUT_QUADS>,
}
words!(RoverHead: first, second, third, output);

/// The head's inputs in whole numbers: means and variances of the wheels' neurons with 15 fraction bits; behind them the
/// inputs that the wheels share and their number with 12, saturated at ±8.
pub struct HeadInputs([Quad; INPUT_QUADS]);

/// What the full range, 32 768, of an input of the head stands for.
pub fn head_input_range(input: usize) -> f32 {
    if input < POOLED { 1.0 } else { (1 << (ACTIVATION_BITS - SUM_BITS)) as f32 }
}

impl HeadInputs {
    /// From means and variances of the wheels' neurons, the normalised inputs that the wheels share, and their number.
    pub fn new(pooled: &[f32; POOLED], context: &[f32; ROVER_CONTEXT], count: f32) -> Self {
        let shared: [f32; ROVER_CONTEXT + 1] = joined([context, &[count]]);
        Self(rounded([(pooled, ACTIVATION_BITS), (&shared, SUM_BITS)]))
    }
}

impl RoverHead {
    /// All weights zero.
    pub const ZERO: Self =
        Self { first: FixedLayer::ZERO, second: FixedLayer::ZERO, third: FixedLayer::ZERO, output: FixedLayer::ZERO };

    /// The network's outputs.
    pub fn run(&self, inputs: &HeadInputs) -> [f32; OUTPUTS] {
        let first: [Quad; FIRST_QUADS] = neurons(&self.first.run(&inputs.0));
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
