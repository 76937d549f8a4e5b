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
        RoverNetwork {
            first: OF_FIRST.round(&self.first),
            second: OF_SECOND.round(&self.second),
            third: OF_THIRD.round(&self.third),
            output: OF_OUTPUT.round(&self.output),
        }
    }

    /// The weights that a network that flies stands for.
    pub fn standing_for(RoverNetwork { first, second, third, output }: &RoverNetwork) -> Self {
        Self {
            first: OF_FIRST.read(first),
            second: OF_SECOND.read(second),
            third: OF_THIRD.read(third),
            output: OF_OUTPUT.read(output),
        }
    }

    /// Takes great sums back to where weights have the fraction bits of [`FRACTION_BITS`]: a single sum of a layer that could be
    /// great costs all of its weights their last bit.
    pub fn bound_each_sum(&mut self) {
        let [first, second, third, output] = FRACTION_BITS;
        OF_FIRST.bound(&mut self.first, first);
        OF_SECOND.bound(&mut self.second, second);
        OF_THIRD.bound(&mut self.third, third);
        OF_OUTPUT.bound(&mut self.output, output);
    }
}

/// Fraction bits that the weights of each layer have at least: one more than training leaves room for where sums are not bounded.
const FRACTION_BITS: [u32; 4] = [8, 10, 10, 11];

type OfSums = Scales<fn(usize) -> f32>;
const OF_FIRST: OfSums = hidden(INPUT_RANGE, gated::<ROVER_FIRST>);
const OF_SECOND: OfSums = hidden(VALUE_RANGE, gated::<ROVER_SECOND>);
const OF_THIRD: OfSums = hidden(VALUE_RANGE, gated::<ROVER_THIRD>);
const OF_OUTPUT: OfSums = Scales { input_range: VALUE_RANGE, sums: |_| 1.0, cut_to: None };

const fn hidden(input_range: f32, sums: fn(usize) -> f32) -> OfSums {
    Scales { input_range, sums, cut_to: Some(SUM_BITS) }
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
    use crate::train::trainable::{Trainable, change_each, flatten, initial};

    /// As what training takes slopes of: the weights are the same, and only what goes from layer to layer is rounded beside.
    #[test]
    fn the_rounded_network_is_nearly_the_same() {
        let weights: RoverWeights = initial(3);
        let flown = weights.rounded();
        assert!(flown.cannot_overflow());
        assert_alike(&weights.as_flown(), |input| flown.run(input));
    }

    #[test]
    fn what_flies_is_within_half_a_step_of_what_was_trained() {
        let weights: RoverWeights = initial(3);
        let (flown, read) = (weights.rounded(), weights.as_flown());
        let step = 1.0 / (f32::from(1_u16 << flown.second.fraction_bits) * VALUE_RANGE * 0.5 * GRADIENT / VALUE_RANGE);
        let pairs = weights.second.weights.0.iter().flatten().zip(read.second.weights.0.iter().flatten());
        let farthest = pairs.fold(0.0_f32, |farthest, (trained, flown)| farthest.max((trained - flown).abs()));
        assert!(farthest > 0.3 * step && farthest <= 0.5001 * step, "{farthest}, steps of {step}");
        let of_bias = weights.second.bias.iter().zip(&read.second.bias).map(|(trained, flown)| (trained - flown).abs());
        assert!(of_bias.fold(0.0_f32, f32::max) < 1e-6);
    }

    #[test]
    fn bounded_sums_leave_the_fraction_bits_that_are_wanted() {
        let mut weights: RoverWeights = initial(3);
        let numbers: Vec<f32> = flatten(&weights).iter().map(|number| 50.0 * number).collect();
        change_each(&mut weights, numbers, |number, great| *number = great);
        weights.bound_each_sum();
        let RoverNetwork { first, second, third, output } = weights.rounded();
        let bits = [first.fraction_bits, second.fraction_bits, third.fraction_bits, output.fraction_bits];
        assert_eq!(bits, FRACTION_BITS);
        let bounded = weights.clone();
        weights.bound_each_sum();
        let pairs = flatten(&weights).into_iter().zip(flatten(&bounded));
        assert!(pairs.into_iter().all(|(twice, once)| (twice - once).abs() <= 1e-5 * once.abs()));
    }
}
