//! Elementary functions in double precision for the host: the bits of `libm`, in less time.
//!
//! `libm`'s functions are calls, each with a branch for every kind of argument, so that a processor works on one at a time. Here
//! the arguments that the wheel–soil equations have are told by one comparison and computed where the function is used; the work
//! on many points then overlaps. All other arguments are left to `libm`. Method and coefficients are those of `libm` (FreeBSD's
//! msun; Copyright 1993, 2004 Sun Microsystems, "permission to use, copy, modify, and distribute this software is freely granted,
//! provided that this notice is preserved"), and so is the order of every operation.

use core::f64::consts::{FRAC_PI_4, LOG2_E};

/// ln 2 in two parts. The upper one has 32 significant bits, so that its product with an exponent is exact.
const LN_2_HIGH: f64 = 0.693_147_180_369_123_8;
const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// Whether `from` ≤ |x| ≤ `to`, of two numbers of zero or more: one comparison, false for NaN.
#[inline(always)]
const fn magnitude_between(x: f64, from: f64, to: f64) -> bool {
    let magnitude = x.to_bits() & !(1 << 63);
    magnitude.wrapping_sub(from.to_bits()) <= to.to_bits() - from.to_bits()
}

/// e to the power of `x`.
#[inline(always)]
pub fn exp(x: f64) -> f64 {
    // From where 1 + x is not all, to where the result is no normal number.
    if magnitude_between(x, 1e-8, 708.0) { normal_exp(x) } else { exp_of_extreme(x) }
}

#[cold]
#[inline(never)]
fn exp_of_extreme(x: f64) -> f64 {
    libm::exp(x)
}

/// With r = x − k ln 2: e^r = 1 + 2r / (R(r) − r), R(r) = r (e^r + 1) / (e^r − 1) = 2 + r² P(r²).
#[inline(always)]
fn normal_exp(x: f64) -> f64 {
    const P: [f64; 5] = [
        0.166_666_666_666_666_02,
        -0.002_777_777_777_701_559_3,
        6.613_756_321_437_934e-5,
        -1.653_390_220_546_525_2e-6,
        4.138_136_797_057_238_5e-8,
    ];
    // Half of ln 2, but for the lower half of its bits, which are ones here.
    const UNREDUCED: f64 = f64::from_bits(0x3fd6_2e42_ffff_ffff);
    let k = if x.to_bits() & !(1 << 63) > UNREDUCED.to_bits() { (LOG2_E * x + 0.5_f64.copysign(x)) as i32 } else { 0 };
    let high = x - f64::from(k) * LN_2_HIGH;
    let low = f64::from(k) * LN_2_LOW;
    let r = high - low;
    let z = r * r;
    let c = r - z * (P[0] + z * (P[1] + z * (P[2] + z * (P[3] + z * P[4]))));
    let mantissa = 1.0 + (r * c / (2.0 - c) - low + high);
    mantissa * f64::from_bits(((1023 + i64::from(k)) << 52).cast_unsigned())
}

/// Natural logarithm; NaN below zero.
#[inline(always)]
pub fn ln(x: f64) -> f64 {
    if (f64::MIN_POSITIVE..=f64::MAX).contains(&x) { normal_ln(x) } else { ln_of_edge(x) }
}

#[cold]
#[inline(never)]
fn ln_of_edge(x: f64) -> f64 {
    libm::log(x)
}

/// With x = 2^k (1 + f), 1 + f in √½ … √2, and s = f/(2 + f): ln(1 + f) = f − f²/2 + s (f²/2 + R(s²)).
#[inline(always)]
fn normal_ln(x: f64) -> f64 {
    const R: [f64; 7] = [
        0.666_666_666_666_673_5,
        0.399_999_999_994_094_2,
        0.285_714_287_436_623_9,
        0.222_221_984_321_497_84,
        0.181_835_721_616_180_5,
        0.153_138_376_992_093_73,
        0.147_981_986_051_165_86,
    ];
    const SQRT_HALF: u64 = 0x3fe6_a09e_0000_0000;
    let above = x.to_bits().wrapping_sub(SQRT_HALF);
    let k = f64::from((above.cast_signed() >> 52) as i32);
    let fraction = f64::from_bits((above & 0x000f_ffff_ffff_ffff) + SQRT_HALF) - 1.0;
    let half_square = 0.5 * fraction * fraction;
    let s = fraction / (2.0 + fraction);
    let z = s * s;
    let w = z * z;
    let even = w * (R[1] + w * (R[3] + w * R[5]));
    let odd = z * (R[0] + w * (R[2] + w * (R[4] + w * R[6])));
    s * (half_square + (odd + even)) + k * LN_2_LOW - half_square + fraction + k * LN_2_HIGH
}

/// Sine and cosine of `x` in radians.
#[inline(always)]
pub fn sin_cos(x: f64) -> (f64, f64) {
    // From where the first term of either series is not all, to where a multiple of π/2 is to be taken off.
    if magnitude_between(x, 1e-7, FRAC_PI_4) { sin_cos_of_eighth(x) } else { sin_cos_of_any(x) }
}

#[cold]
#[inline(never)]
fn sin_cos_of_any(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

#[inline(always)]
fn sin_cos_of_eighth(x: f64) -> (f64, f64) {
    const S: [f64; 6] = [
        -0.166_666_666_666_666_32,
        0.008_333_333_333_322_49,
        -0.000_198_412_698_298_579_5,
        2.755_731_370_707_006_8e-6,
        -2.505_076_025_340_686_3e-8,
        1.589_690_995_211_55e-10,
    ];
    const C: [f64; 6] = [
        0.041_666_666_666_666_6,
        -0.001_388_888_888_887_411,
        2.480_158_728_947_673e-5,
        -2.755_731_435_139_066_3e-7,
        2.087_572_321_298_175e-9,
        -1.135_964_755_778_819_5e-11,
    ];
    let z = x * x;
    let w = z * z;
    let tail = S[1] + z * (S[2] + z * S[3]) + z * w * (S[4] + z * S[5]);
    let sine = x + z * x * (S[0] + z * tail);
    let tail = z * (C[0] + z * (C[1] + z * C[2])) + w * w * (C[3] + z * (C[4] + z * C[5]));
    let half_square = 0.5 * z;
    let high = 1.0 - half_square;
    let cosine = high + (((1.0 - high) - half_square) + z * tail);
    (sine, cosine)
}

#[cfg(test)]
mod tests {
    use core::f64::consts::{FRAC_PI_4, LN_2, SQRT_2};

    use super::{exp, ln, sin_cos};

    /// Arguments all over f64, denser where the equations have theirs, and those beside every place where a function changes
    /// its way.
    fn arguments() -> impl Iterator<Item = f64> {
        // Golden ratio of 2^64: the multiples fill the range evenly, low bits included.
        let spread = |index: u64| index.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let everywhere = (0..2_000_000).map(move |index| f64::from_bits(spread(index)));
        let usual = (0..2_000_000).map(move |index| {
            (spread(index) as f64 / u64::MAX as f64 - 0.5) * if index % 2 == 0 { 2.0 } else { 1500.0 }
        });
        let edges = [
            [0.0, f64::from_bits(1), f64::MIN_POSITIVE, 1e-8, 1e-7, 0.5 * LN_2, 0.5 * SQRT_2, FRAC_PI_4],
            [1.0, 1.5 * LN_2, SQRT_2, 708.0, 709.782_712_893_384, 745.133_219_101_941_1, f64::MAX, f64::INFINITY],
        ];
        let beside = |edge: f64| (-40..40).map(move |ulps| f64::from_bits(edge.to_bits().wrapping_add_signed(ulps)));
        let beside = edges.into_iter().flatten().flat_map(beside);
        everywhere.chain(usual).chain(beside).flat_map(|x| [x, -x])
    }

    #[test]
    fn functions_have_the_bits_of_libm() {
        let is_same = |one: f64, other: f64| one.to_bits() == other.to_bits() || one.is_nan() && other.is_nan();
        for x in arguments() {
            assert!(is_same(exp(x), libm::exp(x)), "exp {x:e}");
            assert!(is_same(ln(x), libm::log(x)), "ln {x:e}");
            let (ours, theirs) = (sin_cos(x), libm::sincos(x));
            assert!(is_same(ours.0, theirs.0) && is_same(ours.1, theirs.1), "sin_cos {x:e}");
        }
    }
}
