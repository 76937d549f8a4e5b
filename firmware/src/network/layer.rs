//! One layer of weighted sums, equation 12.

use super::multiply_accumulate::{HALF, TILE, add_to_half, add_to_tile};
use super::{activate, words};

/// Weights from `I` inputs to `O` sums; one row an input, so that sums run in parallel and their order is fixed.
#[derive(Debug, Clone, PartialEq)]
pub struct Weights<const I: usize, const O: usize>(pub [[f32; O]; I]);

impl<const I: usize, const O: usize> Weights<I, O> {
    /// All weights zero.
    pub const ZERO: Self = Self([[0.0; O]; I]);

    /// Adds the weighted inputs to `sums`, each sum over the inputs in their order.
    pub fn add_to(&self, sums: &mut [f32; O], input: &[f32; I]) {
        let (tiles, rest) = sums.as_chunks_mut::<TILE>();
        for (place, tile) in tiles.iter_mut().enumerate() {
            add_to_tile(tile, input, &self.0, place);
        }
        let (halves, rest) = rest.as_chunks_mut::<HALF>();
        halves.iter_mut().for_each(|half| add_to_half(half, input, &self.0));
        for (x, row) in input.iter().zip(&self.0) {
            rest.iter_mut().zip(row.as_chunks::<HALF>().1).for_each(|(sum, weight)| *sum += x * weight);
        }
    }
}

words!(Weights<I, O> where I, O: 0);

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

    /// What the neurons put out: the bipolar sigmoid of their sums, `gradient` being its coefficient A.
    pub fn run(&self, input: &[f32; I], gradient: f32) -> [f32; O] {
        let mut outputs = self.bias;
        self.weights.add_to(&mut outputs, input);
        activate(&mut outputs, gradient);
        outputs
    }

    /// The weighted sums of the inputs.
    pub fn apply(&self, input: &[f32; I]) -> [f32; O] {
        let mut sums = self.bias;
        self.weights.add_to(&mut sums, input);
        sums
    }
}

words!(Layer<I, O> where I, O: weights, bias);
