//! Rounding to whole numbers and to half the digits.

/// Whole number nearest to `x`, ties to even, as a float and as an integer.
///
/// Holds for |x| ≤ 2²²; beyond, and for NaN, the integer is arbitrary and the float is within 1 + |x|·2⁻²³ of `x`, or NaN.
#[inline]
pub(super) fn nearest(x: f32) -> (f32, i32) {
    // 1.5 · 2²³: between 2²³ and 2²⁴ an f32 has no fraction, and its low bits count in ones.
    const SHIFT: f32 = 12_582_912.0;
    let shifted = x + SHIFT;
    (shifted - SHIFT, shifted.to_bits().wrapping_sub(SHIFT.to_bits()).cast_signed())
}

/// The upper 12 of the 24 significant bits of `x`: products of two of these are exact.
#[inline]
pub(super) fn upper_half(x: f32) -> f32 {
    f32::from_bits(x.to_bits() & 0xffff_f000)
}
