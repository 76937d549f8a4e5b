//! A layer whose neurons multiply: the bipolar sigmoid of one weighted sum, the gate, times a value that another sum gives
//! (Dauphin et al. 2017, "Language Modeling with Gated Convolutional Networks", is the pattern; their gate is 0 … 1).

use pulp::Simd;

use super::lanes::{Lane, ZERO, activate, apply_layer, before_activation};
use super::layer::Layer;

/// Greatest magnitude of a value: so far from the sums it meets that it is nearly the sum itself, yet bounded, as numbers of
/// 16 bits have to be.
pub const VALUE_RANGE: f32 = 4.0;

/// The neurons of a layer for a block of examples: `S` sums, of which the first half make gates and the others the values,
/// and `O` = S / 2 products.
pub struct GatedLanes<const S: usize, const O: usize> {
    /// Gates, then each value as a share of its range.
    activations: [Lane; S],
    /// What the neurons put out.
    pub outputs: [Lane; O],
}

impl<const S: usize, const O: usize> GatedLanes<S, O> {
    /// All zero.
    pub const ZERO: Self = Self { activations: [ZERO; S], outputs: [ZERO; O] };

    /// Computes them.
    #[inline(always)]
    pub fn run<V: Simd, const I: usize>(&mut self, simd: V, layer: &Layer<I, S>, input: &[Lane; I]) {
        apply_layer(simd, layer, input, &mut self.activations);
        self.activations[O..].as_flattened_mut().iter_mut().for_each(|sum| *sum *= 1.0 / VALUE_RANGE);
        activate(&mut self.activations);
        let (gates, shares) = self.activations.split_at(O);
        let pairs = gates.as_flattened().iter().zip(shares.as_flattened());
        for (output, (gate, share)) in self.outputs.as_flattened_mut().iter_mut().zip(pairs) {
            *output = gate * (VALUE_RANGE * share);
        }
    }

    /// The slope before the activations, from the slope behind the products.
    #[inline(always)]
    pub fn before(&self, slope: &[Lane; O]) -> [Lane; S] {
        let mut before = [ZERO; S];
        let (gate_slopes, value_slopes) = before.split_at_mut(O);
        let (gates, shares) = self.activations.split_at(O);
        let places = gate_slopes.as_flattened_mut().iter_mut().zip(value_slopes.as_flattened_mut());
        let pairs = gates.as_flattened().iter().zip(shares.as_flattened());
        for (((of_gate, of_value), (gate, share)), slope) in places.zip(pairs).zip(slope.as_flattened()) {
            *of_gate = slope * (VALUE_RANGE * share);
            // A value's range goes out of its slope again by way of the sum, which is divided by it.
            *of_value = slope * gate;
        }
        before_activation(&mut before, &self.activations);
        before
    }
}
