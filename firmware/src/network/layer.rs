//! One layer of weighted sums, equation 12.

use super::Numbers;

/// Weights from `I` inputs to `O` sums; one row an input, so that sums run in parallel and their order is fixed.
#[derive(Debug, Clone, PartialEq)]
pub struct Weights<const I: usize, const O: usize>(pub [[f32; O]; I]);

impl<const I: usize, const O: usize> Weights<I, O> {
    /// All weights zero.
    pub const ZERO: Self = Self([[0.0; O]; I]);

    /// `sums` with the weighted inputs added.
    pub fn add_to(&self, mut sums: [f32; O], input: &[f32; I]) -> [f32; O] {
        for (x, row) in input.iter().zip(&self.0) {
            for (sum, weight) in sums.iter_mut().zip(row) {
                *sum += x * weight;
            }
        }
        sums
    }
}

impl<const I: usize, const O: usize> Numbers for Weights<I, O> {
    fn for_each(&self, see: &mut impl FnMut(f32)) {
        self.0.for_each(see);
    }
    fn for_each_mut(&mut self, set: &mut impl FnMut(&mut f32)) {
        self.0.for_each_mut(set);
    }
}

/// A layer of `O` neurons on `I` inputs, before their activation.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer<const I: usize, const O: usize> {
    /// Weights of the inputs.
    pub weights: Weights<I, O>,
    /// Weights of the constant input 1.
    pub bias: [f32; O],
}

impl<const I: usize, const O: usize> Layer<I, O> {
    /// All weights zero.
    pub const ZERO: Self = Self { weights: Weights::ZERO, bias: [0.0; O] };

    /// The weighted sums of the inputs.
    pub fn apply(&self, input: &[f32; I]) -> [f32; O] {
        self.weights.add_to(self.bias, input)
    }
}

impl<const I: usize, const O: usize> Numbers for Layer<I, O> {
    fn for_each(&self, see: &mut impl FnMut(f32)) {
        self.weights.for_each(see);
        self.bias.for_each(see);
    }
    fn for_each_mut(&mut self, set: &mut impl FnMut(&mut f32)) {
        self.weights.for_each_mut(set);
        self.bias.for_each_mut(set);
    }
}
