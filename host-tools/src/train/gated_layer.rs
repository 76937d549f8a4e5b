//! A layer whose neurons multiply: the bipolar sigmoid of one weighted sum, the gate, times a value that another sum gives
//! (Dauphin et al. 2017, "Language Modeling with Gated Convolutional Networks", is the pattern; their gate is 0 … 1).

use kapvik_firmware::network::Layer;
use pulp::Simd;

use super::lanes::{Lane, ZERO, apply_layer};
use super::trainable::GRADIENT;
use kapvik_firmware::math::bipolar_sigmoid;

/// Greatest magnitude of a value: so far from the sums it meets that it is nearly the sum itself, yet bounded, as numbers of
/// 16 bits have to be.
pub const VALUE_RANGE: f32 = 4.0;

/// The neurons of a layer for a block of examples: `S` sums, of which the first half make gates and the others the values,
/// and `O` = S / 2 products.
pub struct GatedLanes<const S: usize, const O: usize> {
    gates_and_values: [Lane; S],
    /// What the neurons put out.
    pub outputs: [Lane; O],
}

impl<const S: usize, const O: usize> GatedLanes<S, O> {
    /// All zero.
    pub const ZERO: Self = Self { gates_and_values: [ZERO; S], outputs: [ZERO; O] };

    /// Computes them.
    #[inline(always)]
    pub fn run<V: Simd, const I: usize>(&mut self, simd: V, layer: &Layer<I, S>, input: &[Lane; I]) {
        apply_layer(simd, layer, input, &mut self.gates_and_values);
        let (gates, values) = self.gates_and_values.split_at_mut(O);
        gates.as_flattened_mut().iter_mut().for_each(|sum| *sum = bipolar_sigmoid(*sum, GRADIENT));
        values.as_flattened_mut().iter_mut().for_each(|sum| *sum = value(*sum));
        let pairs = gates.as_flattened().iter().zip(values.as_flattened());
        self.outputs
            .as_flattened_mut()
            .iter_mut()
            .zip(pairs)
            .for_each(|(output, (gate, value))| *output = gate * value);
    }

    /// The slope before the activations, from the slope behind the products.
    #[inline(always)]
    pub fn before(&self, slope: &[Lane; O]) -> [Lane; S] {
        let mut before = [ZERO; S];
        let (gate_slopes, value_slopes) = before.split_at_mut(O);
        let (gates, values) = self.gates_and_values.split_at(O);
        let places = gate_slopes.as_flattened_mut().iter_mut().zip(value_slopes.as_flattened_mut());
        let pairs = gates.as_flattened().iter().zip(values.as_flattened());
        for (((of_gate, of_value), (gate, value)), slope) in places.zip(pairs).zip(slope.as_flattened()) {
            let share = value * (1.0 / VALUE_RANGE);
            *of_gate = slope * value * (0.5 * GRADIENT * (1.0 - gate * gate));
            *of_value = slope * gate * (0.5 * GRADIENT * (1.0 - share * share));
        }
        before
    }
}

/// The value that a sum gives.
#[inline(always)]
fn value(sum: f32) -> f32 {
    VALUE_RANGE * bipolar_sigmoid(sum * (1.0 / VALUE_RANGE), GRADIENT)
}
