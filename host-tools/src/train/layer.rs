//! A layer of weighted sums in single precision, equation 12: what a trainer changes, before it is rounded to fly.

use kapvik_firmware::words;

/// Weights from `I` inputs to `O` sums; one row an input.
#[derive(Debug, Clone, PartialEq)]
pub struct Weights<const I: usize, const O: usize>(pub [[f32; O]; I]);
words!(Weights<I, O> where I, O: 0);

/// A layer of `O` sums of `I` inputs.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer<const I: usize, const O: usize> {
    /// Weights of the inputs.
    pub weights: Weights<I, O>,
    /// Weights of the constant input 1.
    pub bias: [f32; O],
}
words!(Layer<I, O> where I, O: weights, bias);

impl<const I: usize, const O: usize> Layer<I, O> {
    /// All weights zero.
    pub const ZERO: Self = Self { weights: Weights([[0.0; O]; I]), bias: [0.0; O] };
}
