//! The rover network while it is trained: the same network as the flown one, in single precision.

use kapvik_firmware::network::fixed_point::SUM_BITS;
use kapvik_firmware::network::{OUTPUTS, ROVER_FIRST, ROVER_INPUTS, ROVER_SECOND, ROVER_THIRD, RoverNetwork};
use kapvik_firmware::words;

use super::gated_layer::VALUE_RANGE;
use super::layer::Layer;
use super::rounding::{INPUT_RANGE, Scales};
use super::trainable::GRADIENT;

/// Weighted sums of a gated layer: each neuron's gate and, behind all of them, each neuron's value.
pub const FIRST_SUMS: usize = 2 * ROVER_FIRST;
/// The same of the second layer.
pub const SECOND_SUMS: usize = 2 * ROVER_SECOND;
/// The same of the third.
pub const THIRD_SUMS: usize = 2 * ROVER_THIRD;

/// Weights of [`kapvik_firmware::network::RoverNetwork`] before they are rounded.
#[derive(Debug, Clone, PartialEq)]
pub struct RoverWeights {
    /// First layer.
    pub first: Layer<ROVER_INPUTS, FIRST_SUMS>,
    /// Second layer.
    pub second: Layer<ROVER_FIRST, SECOND_SUMS>,
    /// Third layer.
    pub third: Layer<ROVER_SECOND, THIRD_SUMS>,
    /// Linear output: means, then log-variances.
    pub output: Layer<ROVER_THIRD, OUTPUTS>,
}
words!(RoverWeights: first, second, third, output);

impl RoverWeights {
    /// All weights zero.
    pub const ZERO: Self = Self { first: Layer::ZERO, second: Layer::ZERO, third: Layer::ZERO, output: Layer::ZERO };

    /// The network as it flies: rounded to whole numbers.
    pub fn rounded(&self) -> RoverNetwork {
        let (hidden, cut_to) = (VALUE_RANGE, Some(SUM_BITS));
        RoverNetwork {
            first: Scales { input_range: INPUT_RANGE, sums: gated::<ROVER_FIRST>, cut_to }.round(&self.first),
            second: Scales { input_range: hidden, sums: gated::<ROVER_SECOND>, cut_to }.round(&self.second),
            third: Scales { input_range: hidden, sums: gated::<ROVER_THIRD>, cut_to }.round(&self.third),
            output: Scales { input_range: hidden, sums: |_| 1.0, cut_to: None }.round(&self.output),
        }
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
    use super::*;
    use crate::train::rounding::tests::assert_alike;
    use crate::train::trainable::initial;

    #[test]
    fn the_rounded_network_is_nearly_the_same() {
        let weights: RoverWeights = initial(3);
        let flown = weights.rounded();
        assert!(flown.cannot_overflow());
        assert_alike(&weights, |input| flown.run(input));
    }
}
