//! Numbers of single precision to numbers of 16 bits.

use super::{Pair, Quad};
use crate::math::power_of_two;

/// Rounds numbers to so many fraction bits, four a quad; zeros follow the last one, and what has no place is left out. Fraction
/// bits are at most 111.
///
/// Each number goes to the nearest whole multiple of 2^−(fraction bits), the upper one of two that are as near. It is
/// off by at most 0.500 02 of that: negative ones less than 2⁻¹⁶ of it below the middle go up as well. Numbers out of
/// range saturate at −32 768 and 32 767, infinite ones too; NaN gives 0.
pub fn rounded<const H: usize>(numbers: &[f32], fraction_bits: u32) -> [Quad; H] {
    // Sixteen bits more, for the number is then in the upper half of a register, and the conversion saturates.
    let scale = power_of_two(fraction_bits.wrapping_add(16).cast_signed());
    let mut all = [[Pair::ZERO; 2]; H];
    round(numbers, scale, &mut all);
    all
}

// One copy in the image for lists of all lengths.
#[inline(never)]
fn round(numbers: &[f32], scale: f32, places: &mut [Quad]) {
    let mut places = places.iter_mut();
    let (quads, rest) = numbers.as_chunks::<4>();
    for (numbers, place) in quads.iter().zip(&mut places) {
        *place = quad(numbers, scale);
    }
    if !rest.is_empty()
        && let Some(place) = places.next()
    {
        *place = quad(&[0, 1, 2, 3].map(|index| rest.get(index).copied().unwrap_or(0.0)), scale);
    }
}

#[inline]
fn quad(numbers: &[f32; 4], scale: f32) -> Quad {
    // The conversion cuts off; half a unit ahead of that which the shift does makes it round.
    let [a, b, c, d] = numbers.map(|number| (((number * scale) as i32).saturating_add(1 << 15) >> 16) as i16);
    [Pair::new(a, b), Pair::new(c, d)]
}

#[cfg(test)]
mod tests {
    use super::rounded;
    use crate::network::fixed_point::{Pair, Quad};

    fn one(number: f32, fraction_bits: u32) -> i16 {
        let [[pair, _]]: [Quad; 1] = rounded(&[number], fraction_bits);
        pair.halves()[0]
    }

    #[test]
    fn special_values() {
        assert_eq!(one(f32::NAN, 12), 0);
        assert_eq!(one(-f32::NAN, 15), 0);
        assert_eq!([one(f32::INFINITY, 12), one(f32::NEG_INFINITY, 15)], [i16::MAX, i16::MIN]);
        assert_eq!([one(f32::MAX, 15), one(f32::MIN, 15)], [i16::MAX, i16::MIN]);
        assert_eq!([one(1.0, 15), one(-1.0, 15), one(0.999_98, 15)], [i16::MAX, i16::MIN, 32_767]);
        assert_eq!([one(8.0, 12), one(-8.0, 12), one(-8.1, 12)], [i16::MAX, i16::MIN, i16::MIN]);
        assert_eq!([one(0.0, 15), one(-0.0, 15), one(f32::from_bits(1), 15)], [0; 3]);
    }

    #[test]
    fn numbers_go_to_the_nearest() {
        for (number, expected) in
            [(0.5, 1), (-0.5, 0), (1.5, 2), (-1.5, -1), (2.49, 2), (-2.51, -3), (32_767.5, 32_767)]
        {
            assert_eq!([one(number, 0), one(number / 4096.0, 12)], [expected; 2], "{number}");
        }
        for bits in (0..=u32::MAX).step_by(65_537) {
            let number = f32::from_bits(bits);
            let exact = f64::from(number) * 4096.0;
            if exact.abs() < 32_767.0 {
                let error = f64::from(one(number, 12)) - exact;
                assert!(error.abs() <= 0.500_02, "{number}: {error}");
            }
        }
    }

    #[test]
    fn zeros_follow_and_what_has_no_place_is_left_out() {
        let all: [Quad; 3] = rounded(&[1.0, 2.0, 3.0, 4.0, -5.0], 1);
        let numbers = [[2, 4], [6, 8], [-10, 0], [0; 2], [0; 2], [0; 2]];
        assert_eq!(all.as_flattened(), numbers.map(|[a, b]| Pair::new(a, b)));
        let short: [Quad; 1] = rounded(&[1.0; 9], 0);
        assert_eq!(short, [[Pair::new(1, 1); 2]]);
    }
}
