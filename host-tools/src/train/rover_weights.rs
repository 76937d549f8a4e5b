//! The rover network while it is trained: the same network as the flown one, in single precision.

use kapvik_firmware::network::fixed_point::SUM_BITS;
use kapvik_firmware::network::{
    Layer, OUTPUTS, ROVER_CONTEXT, ROVER_FIRST_HEAD, ROVER_HEAD_INPUTS, ROVER_HIDDEN, ROVER_SECOND_HEAD,
    ROVER_THIRD_HEAD, RoverHead, RoverNetwork, WHEEL_FEATURES, Weights, head_input_range,
};
use kapvik_firmware::words;

use super::gated_layer::VALUE_RANGE;
use super::rounding::Scales;
use super::trainable::GRADIENT;

/// Weighted sums of a gated layer: each neuron's gate and, behind all of them, each neuron's value.
pub const FIRST_SUMS: usize = 2 * ROVER_FIRST_HEAD;
/// The same of the second layer behind the pool.
pub const SECOND_SUMS: usize = 2 * ROVER_SECOND_HEAD;
/// The same of the third.
pub const THIRD_SUMS: usize = 2 * ROVER_THIRD_HEAD;

/// Weights of [`kapvik_firmware::network::RoverNetwork`] before they are rounded.
#[derive(Debug, Clone, PartialEq)]
pub struct RoverWeights {
    /// The shared inputs' part in the wheels' layer.
    pub context: Layer<ROVER_CONTEXT, ROVER_HIDDEN>,
    /// A wheel's own part in that layer.
    pub wheel: Weights<WHEEL_FEATURES, ROVER_HIDDEN>,
    /// First layer behind the pool.
    pub first: Layer<ROVER_HEAD_INPUTS, FIRST_SUMS>,
    /// Second layer behind the pool.
    pub second: Layer<ROVER_FIRST_HEAD, SECOND_SUMS>,
    /// Third layer behind the pool.
    pub third: Layer<ROVER_SECOND_HEAD, THIRD_SUMS>,
    /// Linear output: means, then log-variances.
    pub output: Layer<ROVER_THIRD_HEAD, OUTPUTS>,
}
words!(RoverWeights: context, wheel, first, second, third, output);

impl RoverWeights {
    /// All weights zero.
    pub const ZERO: Self = Self {
        context: Layer::ZERO,
        wheel: Weights::ZERO,
        first: Layer::ZERO,
        second: Layer::ZERO,
        third: Layer::ZERO,
        output: Layer::ZERO,
    };

    /// The network as it flies: its head rounded to whole numbers.
    pub fn rounded(&self) -> RoverNetwork {
        let (hidden, cut_to) = (|_| VALUE_RANGE, Some(SUM_BITS));
        let head = RoverHead {
            first: Scales { input_range: head_input_range, sums: gated::<ROVER_FIRST_HEAD>, cut_to }.round(&self.first),
            second: Scales { input_range: hidden, sums: gated::<ROVER_SECOND_HEAD>, cut_to }.round(&self.second),
            third: Scales { input_range: hidden, sums: gated::<ROVER_THIRD_HEAD>, cut_to }.round(&self.third),
            output: Scales { input_range: hidden, sums: |_| 1.0, cut_to: None }.round(&self.output),
        };
        RoverNetwork { context: self.context.clone(), wheel: self.wheel.clone(), head }
    }
}

/// What multiplies a sum of a gated layer of `O` neurons, since flown neurons know no coefficient A and put out a value's
/// share of its range.
fn gated<const O: usize>(sum: usize) -> f32 {
    let of_value = if sum < O { 1.0 } else { 1.0 / VALUE_RANGE };
    0.5 * GRADIENT * of_value
}

#[cfg(test)]
mod tests {
    use kapvik_firmware::network::ROVER_WHEELS;

    use super::*;
    use crate::train::example::{Example, RoverInput};
    use crate::train::trainable::{initial, outputs_of};

    /// Numbers without a pattern, −2 … 2.
    fn wave(seed: usize) -> f32 {
        2.0 * (seed as f32 * 2.399).sin()
    }

    #[test]
    fn the_rounded_network_is_nearly_the_same() {
        let weights: RoverWeights = initial(3);
        let flown = weights.rounded();
        assert!(flown.head.cannot_overflow());
        for seed in 0..200 {
            let input = RoverInput {
                context: std::array::from_fn(|k| wave(seed * 100 + k)),
                wheels: (0..1 + seed % ROVER_WHEELS)
                    .map(|w| std::array::from_fn(|k| wave(seed * 200 + w * 10 + k)))
                    .collect(),
            };
            let of_flown = flown.run(&input.context, input.wheels.iter().copied(), GRADIENT);
            let of_weights = outputs_of(&weights, &[Example { input, target: [0.0; 3] }])[0];
            for (flown, trained) in of_flown.iter().zip(of_weights) {
                assert!((flown - trained).abs() < 2e-3, "{seed}: {of_flown:?}, {of_weights:?}");
            }
        }
    }
}
