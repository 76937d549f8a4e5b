//! Logarithms and powers of two that are straight between whole ones: read off the bits of a number, and written into them.

/// Bits of an exponent of zero.
const ZERO: i32 = 127 << 23;
/// Units of a whole octave.
const OCTAVE: f32 = (1 << 23) as f32;

/// log₂ `x` where that is a whole number, and between such numbers straight in `x`: at most 0.0861 below it. For positive normal numbers;
/// of others it is finite, and means nothing.
#[inline]
pub fn octaves(x: f32) -> f32 {
    x.to_bits().cast_signed().wrapping_sub(ZERO) as f32 * (1.0 / OCTAVE)
}

/// The inverse of [`octaves`]: 2 to the power of `x` where that is a whole number, and straight between, up to 6.2 % above it. For numbers
/// from −126 to 127.
#[inline]
pub fn of_octaves(x: f32) -> f32 {
    f32::from_bits(((x * OCTAVE) as i32).wrapping_add(ZERO).cast_unsigned())
}

#[cfg(test)]
mod tests {
    use super::{octaves, of_octaves};

    #[test]
    fn whole_octaves_are_exact_and_between_them_both_are_straight() {
        for exponent in -126..=127_i32 {
            assert_eq!(octaves(2.0_f32.powi(exponent)), exponent as f32);
            assert_eq!(of_octaves(exponent as f32), 2.0_f32.powi(exponent));
        }
        assert_eq!(octaves(3.0), 1.5);
        assert_eq!(of_octaves(-0.5), 0.75);
    }

    #[test]
    fn they_are_as_near_to_logarithm_and_power_as_is_said_and_undo_each_other() {
        let (mut below, mut above) = (0.0_f64, 0.0_f64);
        for step in -40_000..40_000_i32 {
            let x = step as f32 / 4096.0;
            let power = of_octaves(x);
            above = above.max(f64::from(power) / f64::from(x).exp2() - 1.0);
            below = below.max(f64::from(power).log2() - f64::from(octaves(power)));
            assert!((octaves(power) - x).abs() < 1.0e-6);
        }
        assert!(above < 0.062 && above > 0.061, "{above}");
        assert!(below < 0.0861 && below > 0.086, "{below}");
    }

    #[test]
    fn of_no_number_it_is_finite() {
        for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 0.0, f32::MIN_POSITIVE / 2.0] {
            assert!(octaves(x).is_finite(), "{x}");
        }
    }
}
