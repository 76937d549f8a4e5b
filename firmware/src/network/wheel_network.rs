//! The per-wheel network of the seed: one wheel's state to the soil under it.

use super::fixed_point::{FixedLayer, SUM_BITS, rounded};
use super::shape::{OUTPUTS, WHEEL_HIDDEN, WHEEL_INPUTS};
use super::words;

const INPUT_QUADS: usize = WHEEL_INPUTS.div_ceil(4);
const HIDDEN_QUADS: usize = WHEEL_HIDDEN / 4;
const OUTPUT_QUADS: usize = OUTPUTS.div_ceil(4);

/// Two hidden layers of bipolar sigmoids on the inputs of one wheel, in whole numbers of 16 bits.
#[derive(Debug, Clone, PartialEq)]
pub struct WheelNetwork {
    /// First hidden layer.
    pub first: FixedLayer<INPUT_QUADS, HIDDEN_QUADS>,
    /// Second hidden layer.
    pub second: FixedLayer<HIDDEN_QUADS, HIDDEN_QUADS>,
    /// Linear output: means, then log-variances.
    pub output: FixedLayer<HIDDEN_QUADS, OUTPUT_QUADS>,
}
words!(WheelNetwork: first, second, output);

impl WheelNetwork {
    /// All weights zero.
    pub const ZERO: Self = Self { first: FixedLayer::ZERO, second: FixedLayer::ZERO, output: FixedLayer::ZERO };

    /// The outputs for normalised inputs, which are taken to 1/4096 and saturate at ±8.
    pub fn run(&self, inputs: &[f32; WHEEL_INPUTS]) -> [f32; OUTPUTS] {
        let first = self.first.run(&rounded(inputs, SUM_BITS));
        self.output.outputs(&self.second.run(&first))
    }

    /// Whether no inputs whatever can bring a sum past 32 bits, on which flight relies.
    pub fn cannot_overflow(&self) -> bool {
        self.first.cannot_overflow() && self.second.cannot_overflow() && self.output.cannot_overflow()
    }
}
