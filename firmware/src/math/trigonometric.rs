//! Sine, cosine and arc cosine.

use super::rounding::nearest;
use super::{abs, magnitude_between, sqrt};
use core::f32::consts::{FRAC_2_PI, TAU};

/// Magnitude below which sine and arc sine are their argument to a fifth of an ulp: 2⁻¹².
const SMALL: f32 = 1.0 / 4096.0;

/// Magnitude below which nothing has to be taken off: a little less than π/4.
const EIGHTH: f32 = 0.785;

/// Magnitude below which a multiple of π/2 is taken off without loss: the multiple is at most 2⁸.
const REDUCED_EXACTLY: f32 = 402.0;

/// π/2 in three parts. The upper two have 16 significant bits, so that their product with a multiple up to 256 is exact.
const FRAC_PI_2_PARTS: [f32; 3] = [1.570_800_8, -4.454_399_5e-6, -5.564_431_6e-11];

/// π/2 as the nearest f32 and what that one lacks.
const FRAC_PI_2: f32 = core::f32::consts::FRAC_PI_2;
const FRAC_PI_2_REST: f32 = -4.371_139e-8;

/// Sine and cosine of `x` in radians.
///
/// The worst error of either is 1.31 ulp for |x| ≤ 2π and 1.44 ulp for |x| ≤ 400, near the zeros too. Beyond, where
/// neighbouring f32 are 3·10⁻⁵ rad and more apart, the absolute error is at most 2⁻²²·|x|: the result is that of an angle
/// nearby. It is always in −1 … 1, the sine is odd and the cosine even to the last bit. ±∞ and NaN give NaN.
#[inline(always)] // in the innermost loops, where the image is else compiled for its size
pub fn sin_cos(x: f32) -> (f32, f32) {
    let mut angle = abs(x);
    if !magnitude_between(x, SMALL, REDUCED_EXACTLY) {
        if angle < SMALL {
            return (x, 1.0);
        }
        angle = within_one_turn(angle);
    }
    let (count, quarter) = nearest(angle * FRAC_2_PI);
    let [high, middle, low] = FRAC_PI_2_PARTS;
    let less_high = angle - count * high;
    let remainder = less_high - count * middle;
    // The subtraction before is the first that rounds: what it lost, and the last part.
    let rest = ((less_high - remainder) - count * middle) - count * low;
    let (sine, cosine) = sin_cos_of_eighth(remainder, rest);

    let quarter = quarter.cast_unsigned();
    let (sine, cosine) = if quarter & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
    let sine_sign = (quarter << 30) ^ x.to_bits();
    let cosine_sign = quarter.wrapping_add(1) << 30;
    (with_sign_flipped(sine, sine_sign), with_sign_flipped(cosine, cosine_sign))
}

/// [`sin_cos`], the same bits, in half the time for magnitudes below an eighth of a turn, where the multiple of π/2 that is taken off
/// is nought: few angles of a rover are larger.
#[inline(never)] // flash is scarcer than the time of a call
pub fn sin_cos_of_slope(x: f32) -> (f32, f32) {
    if magnitude_between(x, SMALL, EIGHTH) { sin_cos_of_eighth(x, 0.0) } else { sin_cos(x) }
}

/// An angle in −π … π that is `angle` less whole turns, to 2⁻²²·|angle|; NaN if `angle` is not finite.
#[cold]
#[inline(never)]
fn within_one_turn(angle: f32) -> f32 {
    let turns = angle * (1.0 / TAU);
    let whole = if turns < 4_194_304.0 { nearest(turns).0 } else { turns };
    (turns - whole) * TAU
}

/// Sine and cosine of r + rest, |r| ≤ π/4 or a little more, |rest| some ulp of r at most; the cosine does without.
///
/// sin r = r + r³ S(r²) and cos r = 1 − r²/2 + r⁴ C(r²), both of degree 2, fitted on |r| ≤ 0.786 for the relative
/// errors of sine and cosine, which are 2^−27.9 and 2^−33.0.
#[inline]
fn sin_cos_of_eighth(r: f32, rest: f32) -> (f32, f32) {
    const S: [f32; 3] = [-0.166_666_55, 0.008_332_187, -0.000_195_178_97];
    const C: [f32; 3] = [0.041_666_646, -0.001_388_731, 2.443_232_7e-5];
    let z = r * r;
    let sine = r + (rest + r * z * ((S[2] * z + S[1]) * z + S[0]));
    let cosine = 1.0 - (0.5 * z - z * z * ((C[2] * z + C[1]) * z + C[0]));
    (sine, cosine)
}

/// `x` with its sign flipped if the top bit of `sign` is set.
#[inline]
fn with_sign_flipped(x: f32, sign: u32) -> f32 {
    f32::from_bits(x.to_bits() ^ (sign & 0x8000_0000))
}

/// Arc cosine in radians.
///
/// Defined on −1 … 1; NaN elsewhere. Worst error 1.14 ulp, near 1 too, where the result goes to 0.
pub fn acos(x: f32) -> f32 {
    let magnitude = abs(x);
    if magnitude <= 0.5 {
        let excess = if magnitude < SMALL { 0.0 } else { asin_excess(x, x * x) };
        return FRAC_PI_2 - (x - (FRAC_PI_2_REST - excess));
    }
    // Half the angle: cos 2a = 1 − 2 sin² a. The difference is exact; outside −1 … 1 the root gives NaN.
    let square = 0.5 * (1.0 - magnitude);
    let sine = sqrt(square);
    let half_angle = sine + asin_excess(sine, square);
    if x > 0.0 { 2.0 * half_angle } else { 2.0 * (FRAC_PI_2 - (half_angle - FRAC_PI_2_REST)) }
}

/// arcsin x − x for |x| ≤ ½, given x².
///
/// x³ A(x²), A of degree 4, fitted on 0 ≤ x² ≤ ¼ for the relative error of the arc sine, which is 2^−27.6.
#[inline]
fn asin_excess(x: f32, square: f32) -> f32 {
    const A: [f32; 5] = [0.166_667_52, 0.074_953_094, 0.045_469_154, 0.024_184_741, 0.042_158_4];
    let z = square;
    x * z * ((((A[4] * z + A[3]) * z + A[2]) * z + A[1]) * z + A[0])
}

#[cfg(test)]
mod tests {
    use super::{acos, sin_cos, sin_cos_of_slope};
    use core::f32::consts::{FRAC_PI_2, FRAC_PI_3, PI};

    #[test]
    fn sine_and_cosine_of_special_values() {
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
        assert_eq!(sin_cos(-0.0).0.to_bits(), (-0.0_f32).to_bits());
        // What is left of the nearest f32 to pi/2 and pi, from the decimal expansion of pi.
        assert_eq!(sin_cos(FRAC_PI_2), (1.0, -4.371_139e-8));
        assert_eq!(sin_cos(PI), (-8.742_278e-8, -1.0));
        for x in [f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
            let (sine, cosine) = sin_cos(x);
            assert!(sine.is_nan() && cosine.is_nan());
        }
    }

    #[test]
    fn sine_and_cosine_of_slopes_have_the_same_bits() {
        let bits = |(sine, cosine): (f32, f32)| (sine.to_bits(), cosine.to_bits());
        for x in (0..=u32::from(u16::MAX)).map(|upper| f32::from_bits(upper << 16 | 0x5a5a)) {
            assert_eq!(bits(sin_cos_of_slope(x)), bits(sin_cos(x)), "{x}");
        }
    }

    #[test]
    fn arc_cosine_of_special_values() {
        assert_eq!(acos(1.0), 0.0);
        assert_eq!(acos(0.5), FRAC_PI_3);
        assert_eq!(acos(0.0), FRAC_PI_2);
        assert_eq!(acos(-0.0), FRAC_PI_2);
        assert_eq!(acos(-1.0), PI);
        for x in [1.0_f32.next_up(), -1.0_f32.next_up(), f32::MAX, f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
            assert!(acos(x).is_nan());
        }
    }
}
