//! The per-wheel network of the seed: one wheel's state to the soil under it.

use super::shape::{OUTPUTS, WHEEL_HIDDEN, WHEEL_INPUTS};
use super::{Layer, numbers};

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
numbers!(WheelNetwork: first, second, output);

/// What the neurons put out for one input; a trainer needs it to propagate errors back.
#[derive(Debug, Clone)]
pub struct WheelActivations {
    /// Of the first hidden layer.
    pub first: [f32; WHEEL_HIDDEN],
    /// Of the second hidden layer.
    pub second: [f32; WHEEL_HIDDEN],
    /// Of the output layer.
    pub output: [f32; OUTPUTS],
}

impl WheelNetwork {
    /// All weights zero.
    pub const ZERO: Self = Self { first: Layer::ZERO, second: Layer::ZERO, output: Layer::ZERO };

    /// Runs the network on normalised inputs; `gradient` is A of equation 13.
    pub fn run(&self, input: &[f32; WHEEL_INPUTS], gradient: f32) -> WheelActivations {
        let first = self.first.run(input, gradient);
        let second = self.second.run(&first, gradient);
        WheelActivations { first, second, output: self.output.apply(&second) }
    }
}
