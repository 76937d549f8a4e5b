//! One layer of weighted sums, equation 12.

use super::Numbers;

/// Sums that are worked on at once: as many as stay in the target's registers beside their operands.
const TILE: usize = 8;

/// Weights from `I` inputs to `O` sums; one row an input, so that sums run in parallel and their order is fixed.
#[derive(Debug, Clone, PartialEq)]
pub struct Weights<const I: usize, const O: usize>(pub [[f32; O]; I]);

impl<const I: usize, const O: usize> Weights<I, O> {
    /// All weights zero.
    pub const ZERO: Self = Self([[0.0; O]; I]);

    /// `sums` with the weighted inputs added, each sum over the inputs in their order.
    pub fn add_to(&self, mut sums: [f32; O], input: &[f32; I]) -> [f32; O] {
        let (tiles, rest) = sums.as_chunks_mut::<TILE>();
        for (place, tile) in tiles.iter_mut().enumerate() {
            let mut held = *tile;
            for (x, row) in input.iter().zip(&self.0) {
                if let Some(weights) = row.as_chunks::<TILE>().0.get(place) {
                    held.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += x * weight);
                }
            }
            *tile = held;
        }
        for (x, row) in input.iter().zip(&self.0) {
            rest.iter_mut().zip(row.as_chunks::<TILE>().1).for_each(|(sum, weight)| *sum += x * weight);
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
