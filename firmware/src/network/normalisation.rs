//! Inputs on the scale that a network was trained on, and whether they lie where it was trained.

use super::words;

/// Offset, scale and training range of `N` inputs, in the inputs' own units.
#[derive(Debug, Clone, PartialEq)]
pub struct Normalisation<const N: usize> {
    /// Subtracted from each input.
    pub offset: [f32; N],
    /// Multiplies each input after that.
    pub scale: [f32; N],
    /// Least value of the training range.
    pub low: [f32; N],
    /// Greatest value of the training range.
    pub high: [f32; N],
}

impl<const N: usize> Normalisation<N> {
    /// Zero range and zero scale, for a table that is about to be filled.
    pub const ZERO: Self = Self { offset: [0.0; N], scale: [0.0; N], low: [0.0; N], high: [0.0; N] };

    /// The inputs on the network's scale.
    pub fn apply(&self, input: &[f32; N]) -> [f32; N] {
        let mut normal = *input;
        for ((x, offset), scale) in normal.iter_mut().zip(&self.offset).zip(&self.scale) {
            *x = (*x - offset) * scale;
        }
        normal
    }

    /// Whether every input lies in the training range; NaN does not.
    pub fn contains(&self, input: &[f32; N]) -> bool {
        input.iter().zip(&self.low).zip(&self.high).all(|((x, low), high)| low <= x && x <= high)
    }
}

words!(Normalisation<N> where N: offset, scale, low, high);
