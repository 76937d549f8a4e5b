//! One layer of weighted sums of whole numbers, equation 12.

use super::activation::{ACTIVATION_BITS, SUM_BITS, activated};
use super::multiply_accumulate::weighted_sums;
use super::{Pair, Quad};
use crate::math::power_of_two;
use crate::network::words;

/// The most fraction bits that weights have.
pub const MAX_WEIGHT_BITS: u32 = 15;

/// A layer of 4 `T` neurons on 4 `H` inputs, in whole numbers.
///
/// Its one unit is the weights' fraction bits: a weight w is the whole number w · 2^(fraction bits), on an input with
/// 15 fraction bits. Sums and biases then have 15 more than the weights. On an input with 12 fraction bits it is w ·
/// 2^(fraction bits + 3).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FixedLayer<const H: usize, const T: usize> {
    /// Weights in the order in which they are worked through: tile of four neurons by tile, in it quad of inputs by
    /// quad, in it pair of inputs by pair, in it the weights of that pair for each of the four neurons.
    pub weights: [[[[Pair; 4]; 2]; H]; T],
    /// Weights of the constant input 1, in units of the products: 2^−(15 + fraction bits). Sums are cut off on their
    /// way to the activation; who adds half a unit of what they become, 2^(fraction bits + 2), has them rounded.
    pub bias: [[i32; 4]; T],
    /// Fraction bits of the weights, 0 … 15; more count as 15.
    pub fraction_bits: u32,
}

words!(FixedLayer<H, T> where H, T: weights, bias, fraction_bits);

impl<const H: usize, const T: usize> FixedLayer<H, T> {
    /// All weights zero.
    pub const ZERO: Self = Self { weights: [[[[Pair::ZERO; 4]; 2]; H]; T], bias: [[0; 4]; T], fraction_bits: 0 };

    /// Fraction bits of sums and biases.
    const fn sum_bits(&self) -> u32 {
        let most = self.fraction_bits > MAX_WEIGHT_BITS;
        ACTIVATION_BITS + if most { MAX_WEIGHT_BITS } else { self.fraction_bits }
    }

    /// The weighted sums of the inputs, with 15 fraction bits more than the weights. They wrap around where
    /// [`FixedLayer::cannot_overflow`] is false.
    pub fn sums(&self, input: &[Quad; H]) -> [[i32; 4]; T] {
        weighted_sums(&self.bias, input, &self.weights)
    }

    /// What the neurons put out: the bipolar sigmoid of their sums, with 15 fraction bits.
    pub fn run(&self, input: &[Quad; H]) -> [Quad; T] {
        activated(&self.sums(input), self.sum_bits() - SUM_BITS)
    }

    /// The first `N` sums as numbers, rounded to single precision; those beyond the 4 `T` sums are 0.
    pub fn outputs<const N: usize>(&self, input: &[Quad; H]) -> [f32; N] {
        let unit = power_of_two(-self.sum_bits().cast_signed());
        let mut outputs = [0.0; N];
        for (output, sum) in outputs.iter_mut().zip(self.sums(input).as_flattened()) {
            *output = *sum as f32 * unit;
        }
        outputs
    }

    /// Whether no inputs whatever, −32 768 included, can bring a sum past 32 bits: for each neuron the magnitudes of
    /// bias and weights, times 32 768 each, add up to no more than 2³¹ − 1. For whoever makes a table; flight relies
    /// on it.
    pub fn cannot_overflow(&self) -> bool {
        self.weights.iter().zip(&self.bias).all(|(tile, bias)| {
            let mut greatest = bias.map(|bias| u64::from(bias.unsigned_abs()));
            for weights in tile.as_flattened() {
                for (sum, pair) in greatest.iter_mut().zip(weights) {
                    let magnitudes = pair.halves().map(|weight| u64::from(weight.unsigned_abs()));
                    *sum += magnitudes.iter().sum::<u64>() << 15;
                }
            }
            greatest.iter().all(|&sum| sum <= u64::from(i32::MAX.unsigned_abs()))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::FixedLayer;
    use crate::network::fixed_point::{Pair, Quad, bipolar_sigmoid};

    /// The next of a row of numbers (a linear congruential generator, its upper half folded into the lower).
    fn drawn(state: &mut u32) -> u32 {
        *state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        *state ^ *state >> 16
    }

    /// Every seventh number is an extreme one.
    fn drawn_pair(state: &mut u32) -> Pair {
        let pair = Pair(drawn(state));
        match drawn(state) % 7 {
            0 => Pair(0x8000_8000),
            _ => pair,
        }
    }

    fn drawn_layer<const H: usize, const T: usize>(state: &mut u32) -> (FixedLayer<H, T>, [Quad; H]) {
        let mut layer = FixedLayer::ZERO;
        layer.weights.as_flattened_mut().as_flattened_mut().as_flattened_mut().fill_with(|| drawn_pair(state));
        layer.bias.as_flattened_mut().fill_with(|| drawn(state).cast_signed());
        layer.fraction_bits = drawn(state) % 16;
        let mut input = [[Pair::ZERO; 2]; H];
        input.as_flattened_mut().fill_with(|| drawn_pair(state));
        (layer, input)
    }

    /// Sums in 64 bits, from the weights' places alone.
    fn exact<const H: usize, const T: usize>(layer: &FixedLayer<H, T>, input: &[Quad; H]) -> Vec<i64> {
        let inputs: Vec<i16> = input.as_flattened().iter().flat_map(|pair| pair.halves()).collect();
        let sum = |neuron: usize| {
            let (tile, column) = (neuron / 4, neuron % 4);
            let products = inputs.iter().enumerate().map(|(place, &x)| {
                let weight = layer.weights[tile][place / 4][place / 2 % 2][column].halves()[place % 2];
                i64::from(x) * i64::from(weight)
            });
            i64::from(layer.bias[tile][column]) + products.sum::<i64>()
        };
        (0..4 * T).map(sum).collect()
    }

    fn check<const H: usize, const T: usize>(state: &mut u32) {
        for _ in 0..50 {
            let (layer, input) = drawn_layer::<H, T>(state);
            let sums = layer.sums(&input);
            let run = layer.run(&input);
            let activations: Vec<i16> = run.as_flattened().iter().flat_map(|pair| pair.halves()).collect();
            let outputs = layer.outputs::<5>(&input);
            for (neuron, exact) in exact(&layer, &input).into_iter().enumerate() {
                let sum = sums.as_flattened()[neuron];
                assert_eq!(sum, exact as i32, "{neuron} of {H} by {T}");
                let shifted = f64::from(sum) / f64::from(1_u32 << (layer.fraction_bits + 3));
                assert_eq!(activations[neuron], bipolar_sigmoid(shifted.floor() as i16));
                if let Some(output) = outputs.get(neuron) {
                    let expected = f64::from(sum) * 0.5_f64.powi(layer.fraction_bits as i32 + 15);
                    assert_eq!(*output, expected as f32);
                }
            }
            assert!(outputs.iter().skip(4 * T).all(|&output| output == 0.0));
        }
    }

    #[test]
    fn sums_are_those_in_64_bits() {
        let mut state = 1;
        check::<0, 1>(&mut state);
        check::<1, 1>(&mut state);
        check::<2, 3>(&mut state);
        check::<3, 2>(&mut state);
        check::<11, 18>(&mut state);
        assert!(FixedLayer::<4, 0>::ZERO.run(&[[Pair::ZERO; 2]; 4]).is_empty());
    }

    #[test]
    fn overflow_is_foreseen_to_the_unit() {
        let mut layer = FixedLayer::<2, 2>::ZERO;
        assert!(layer.cannot_overflow());
        // 65 535 magnitudes of 32 768 leave room for a bias of 32 767.
        layer.weights[1][0][0][2] = Pair::new(i16::MIN, i16::MAX);
        assert!(layer.cannot_overflow());
        layer.bias[1][2] = -32_767;
        assert!(layer.cannot_overflow());
        let lowest = layer.sums(&[[Pair::new(i16::MAX, i16::MIN), Pair::ZERO], [Pair::ZERO; 2]]);
        assert_eq!(i64::from(lowest[1][2]), -32_767 - 32_768 * 32_767 - 32_767 * 32_768);
        layer.bias[1][2] = 32_768;
        assert!(!layer.cannot_overflow());
        layer.bias[1][2] = 0;
        layer.weights[1][1][1][2] = Pair::new(0, -1);
        assert!(!layer.cannot_overflow());
        layer.weights = FixedLayer::<2, 2>::ZERO.weights;
        layer.bias[0][0] = i32::MIN;
        assert!(!layer.cannot_overflow());
    }

    #[test]
    fn too_many_fraction_bits_count_as_fifteen() {
        let mut state = 7;
        let (mut layer, input) = drawn_layer::<3, 2>(&mut state);
        layer.fraction_bits = 15;
        let (run, outputs) = (layer.run(&input), layer.outputs::<8>(&input));
        layer.fraction_bits = u32::MAX;
        assert_eq!((layer.run(&input), layer.outputs::<8>(&input)), (run, outputs));
    }

    #[test]
    fn debug_text_is_rust_source() {
        let mut layer = FixedLayer::<1, 1>::ZERO;
        layer.weights[0][0][1][3] = Pair::new(-1, 2);
        layer.bias[0][0] = -5;
        let expected = FixedLayer {
            weights: [[[[Pair(0), Pair(0), Pair(0), Pair(0)], [Pair(0), Pair(0), Pair(0), Pair(196607)]]]],
            bias: [[-5, 0, 0, 0]],
            fraction_bits: 0,
        };
        assert_eq!(layer, expected);
        let text = "FixedLayer { weights: [[[[Pair(0), Pair(0), Pair(0), Pair(0)], \
                    [Pair(0), Pair(0), Pair(0), Pair(196607)]]]], bias: [[-5, 0, 0, 0]], fraction_bits: 0 }";
        assert_eq!(format!("{layer:?}"), text);
    }
}
