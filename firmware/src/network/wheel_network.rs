//! The per-wheel network of the seed: one wheel's state to the soil under it.

use super::shape::{OUTPUTS, WHEEL_HIDDEN, WHEEL_INPUTS};
use super::{Layer, words};

/// Two hidden layers on the inputs of one wheel.
#[derive(Debug, Clone, PartialEq)]
pub struct WheelNetwork {
    /// First hidden layer.
    pub first: Layer<WHEEL_INPUTS, WHEEL_HIDDEN>,
    /// Second hidden layer.
    pub second: Layer<WHEEL_HIDDEN, WHEEL_HIDDEN>,
    /// Linear output: means, then log-variances.
    pub output: Layer<WHEEL_HIDDEN, OUTPUTS>,
}
words!(WheelNetwork: first, second, output);

impl WheelNetwork {
    /// All weights zero.
    pub const ZERO: Self = Self { first: Layer::ZERO, second: Layer::ZERO, output: Layer::ZERO };

    /// Runs the network on normalised inputs; `gradient` is A of equation 13.
    pub fn run(&self, input: &[f32; WHEEL_INPUTS], gradient: f32) -> [f32; OUTPUTS] {
        let first = self.first.run(input, gradient);
        let second = self.second.run(&first, gradient);
        self.output.apply(&second)
    }
}
