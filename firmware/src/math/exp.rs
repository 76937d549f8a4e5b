//! The exponential function.

use super::rounding::nearest;
use super::{abs, magnitude_between};
use core::f32::consts::LOG2_E;

/// ln 2 in two parts. The upper one has 15 significant bits, so that its product with an exponent is exact.
pub(super) const LN_2_HIGH: f32 = 0.693_145_75;
pub(super) const LN_2_LOW: f32 = 1.428_606_8e-6;

/// Magnitude of the argument below which the result is 1 + x to a tenth of an ulp: 2⁻¹³.
const SMALL: f32 = 1.0 / 8192.0;

/// Magnitude of the argument up to which the result is a normal number: ln(2¹²⁶) = 87.34.
const NORMAL: f32 = 87.3;

/// e to the power of `x`.
///
/// Defined for every f32. Worst error 0.99 ulp; of a subnormal result, in the ulp of subnormals. From 88.722 84 (ln 2¹²⁸) on the result is +∞, below
/// −103.972 08 (ln 2⁻¹⁵⁰) it is 0; ∞ gives ∞ and −∞ gives 0.
#[inline(always)] // in the innermost loops, where the image is else compiled for its size
pub fn exp(x: f32) -> f32 {
    // Minus zero is the neutral element of addition (plus zero is not, for it turns −0 to +0): it costs nothing.
    exp_of_sum(x, -0.0)
}

/// e to the power of `high + low`, where `low` is what `high` lacks: |low| ≤ |high|·2⁻²³.
#[inline]
pub(super) fn exp_of_sum(high: f32, low: f32) -> f32 {
    if magnitude_between(high, SMALL, NORMAL) {
        let (mantissa, exponent) = reduced(high, low);
        f32::from_bits(mantissa.to_bits().wrapping_add_signed(exponent << 23))
    } else {
        exp_of_extreme(high, low)
    }
}

/// The same where the result is near 1, or may be subnormal, zero, infinite or NaN.
#[cold]
#[inline(never)]
fn exp_of_extreme(high: f32, low: f32) -> f32 {
    if high > 89.0 {
        return f32::INFINITY;
    }
    if high < -104.0 {
        return 0.0;
    }
    if abs(high) < SMALL {
        return 1.0 + (high + low);
    }
    let (mantissa, exponent) = reduced(high, low);
    // 2^exponent may be no normal number: two steps, of which only the last can round.
    let half = exponent >> 1;
    mantissa * power_of_two(half) * power_of_two(exponent.wrapping_sub(half))
}

/// 2^k for −126 ≤ k ≤ 127.
#[inline]
pub(crate) const fn power_of_two(k: i32) -> f32 {
    f32::from_bits((k.wrapping_add(127) << 23).cast_unsigned())
}

/// (m, k) such that e^(high + low) = m·2^k, with m in 0.70 … 1.42.
///
/// With r = high + low − k ln 2, |r| ≤ ln 2 / 2: e^r = 1 + r + r² P(r), P of degree 4, fitted on |r| ≤ 0.3476 for the
/// relative error of e^r, which is 2^−28.2.
#[inline]
fn reduced(high: f32, low: f32) -> (f32, i32) {
    const P: [f32; 5] = [0.499_999_94, 0.166_665_21, 0.041_668_292, 0.008_368_721, 0.001_381_874_2];
    let (count, k) = nearest(high * LOG2_E);
    let r = (high - count * LN_2_HIGH) + (low - count * LN_2_LOW);
    let p = (((P[4] * r + P[3]) * r + P[2]) * r + P[1]) * r + P[0];
    (1.0 + (r + r * r * p), k)
}

#[cfg(test)]
mod tests {
    use super::exp;

    #[test]
    fn special_values() {
        assert_eq!(exp(0.0), 1.0);
        assert_eq!(exp(-0.0), 1.0);
        assert_eq!(exp(1.0), core::f32::consts::E);
        assert_eq!(exp(f32::INFINITY), f32::INFINITY);
        assert_eq!(exp(f32::NEG_INFINITY), 0.0);
        assert!(exp(f32::NAN).is_nan());
    }

    #[test]
    fn overflow_and_underflow_begin_where_stated() {
        let overflows = 88.722_84_f32; // ln(2^128) = 88.722 839 1; the f32 below gives a finite result
        assert_eq!(exp(overflows), f32::INFINITY);
        assert!(exp(overflows.next_down()).is_finite());
        let vanishes = -103.972_084_f32; // ln(2^-150) = -103.972 077; the f32 above rounds to the smallest subnormal
        assert_eq!(exp(vanishes), 0.0);
        assert_eq!(exp(vanishes.next_up()), f32::from_bits(1));
    }
}
