//! The natural logarithm.

use super::exp::{LN_2_HIGH, LN_2_LOW};

/// Natural logarithm.
///
/// Defined for every f32 of zero or more, subnormals included. Worst error 0.84 ulp; near 1 the error stays relative.
/// ±0 gives −∞, ∞ gives ∞, a negative argument gives NaN.
#[inline(always)] // in the innermost loops, where the image is else compiled for its size
pub fn ln(x: f32) -> f32 {
    let Some(Scaled { exponent, fraction }) = Scaled::of(x) else {
        return ln_of_edge(x);
    };
    let half_square = 0.5 * fraction * fraction;
    let tail = tail(fraction, half_square);
    exponent * LN_2_HIGH + (fraction - (half_square - (tail + exponent * LN_2_LOW)))
}

/// Logarithm of what is no positive finite number.
#[cold]
#[inline(never)]
fn ln_of_edge(x: f32) -> f32 {
    if x == 0.0 {
        f32::NEG_INFINITY
    } else if x < 0.0 {
        f32::NAN
    } else {
        x
    }
}

/// A positive number as 2^exponent · (1 + fraction), both exact, 1 + fraction in √½ … √2.
pub(super) struct Scaled {
    pub exponent: f32,
    pub fraction: f32,
}

impl Scaled {
    /// `None` where `x` is not positive or not finite.
    #[inline]
    pub fn of(x: f32) -> Option<Self> {
        let bits = x.to_bits();
        if bits.wrapping_sub(0x0080_0000) < 0x7f00_0000 {
            Some(Self::of_normal(bits, 0))
        } else if bits.wrapping_sub(1) < 0x007f_ffff {
            Some(Self::of_normal((x * 16_777_216.0).to_bits(), -24))
        } else {
            None
        }
    }

    #[inline]
    fn of_normal(bits: u32, offset: i32) -> Self {
        const SQRT_HALF: u32 = 0x3f35_04f3;
        let above = bits.wrapping_sub(SQRT_HALF);
        let exponent = (above.cast_signed() >> 23).wrapping_add(offset);
        let mantissa = f32::from_bits((above & 0x007f_ffff).wrapping_add(SQRT_HALF));
        Self { exponent: exponent as f32, fraction: mantissa - 1.0 }
    }
}

/// ln(1 + f) − f + f²/2, given f²/2.
///
/// With s = f/(2 + f), ln(1 + f) = 2 artanh s = 2s + s R(s²) and 2s = f − s f; hence f − f²/2 + s (f²/2 + R), in which
/// the rounding of s touches only what is small. R(z) = z L(z), L of degree 2, fitted on 0 ≤ z ≤ 0.0295 (f in √½ − 1 …
/// √2 − 1) for the relative error of the logarithm, which is 2^−30.2.
#[inline]
pub(super) fn tail(fraction: f32, half_square: f32) -> f32 {
    const L: [f32; 3] = [0.666_667_76, 0.399_775_68, 0.298_714_6];
    let s = fraction / (2.0 + fraction);
    let z = s * s;
    s * (half_square + z * ((L[2] * z + L[1]) * z + L[0]))
}

#[cfg(test)]
mod tests {
    use super::ln;
    use core::f32::consts::LN_2;

    #[test]
    fn special_values() {
        assert_eq!(ln(1.0).to_bits(), 0.0_f32.to_bits());
        assert_eq!(ln(2.0), LN_2);
        assert_eq!(ln(0.5), -LN_2);
        assert_eq!(ln(0.0), f32::NEG_INFINITY);
        assert_eq!(ln(-0.0), f32::NEG_INFINITY);
        assert_eq!(ln(f32::INFINITY), f32::INFINITY);
        assert!(ln(-1.0).is_nan());
        assert!(ln(-f32::MIN_POSITIVE).is_nan());
        assert!(ln(f32::NEG_INFINITY).is_nan());
        assert!(ln(f32::NAN).is_nan());
    }

    #[test]
    fn smallest_subnormal() {
        assert_eq!(ln(f32::from_bits(1)), -149.0 * LN_2);
    }
}
