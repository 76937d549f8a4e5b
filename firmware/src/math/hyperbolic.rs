//! The hyperbolic tangent, and the activation of equation 13 made of it; the networks that fly have theirs in whole numbers.

use super::{abs, magnitude_between};

/// Magnitude below which the tangent is its argument to 2·10⁻⁸ of it: 2⁻¹².
const SMALL: f32 = 1.0 / 4096.0;

/// Magnitude from which on the result is ±1; 1 − tanh 8 is 2.3·10⁻⁷.
const SATURATED: f32 = 8.0;

/// Hyperbolic tangent, built to be cheap.
///
/// Defined for every f32. Absolute error at most 3.6·10⁻⁷, relative error at most 5.1·10⁻⁷; odd to the last bit, within
/// −1 … 1, and ±1 from |x| = 8 on. Not quite monotone: between neighbours it may step back by 2.4·10⁻⁷. ±∞ give ±1, NaN
/// gives NaN.
///
/// By the double-angle formula tanh x = n d / (n²/4 + d²) with n/d near to 2 tanh(x/2), n = x (1 + N₁z + N₂z²), d = 1 +
/// D₁z + D₂z², z = x². No value of n/d gets it past 1, and as n/d goes to 2 the error of the quotient vanishes. Fitted on
/// |x| ≤ 8 for the absolute error of the tangent, which is 1.7·10⁻⁷, the leading coefficients held at 1.
#[inline]
pub const fn tanh(x: f32) -> f32 {
    const N: [f32; 2] = [0.027_050_784, 5.556_190_8e-5];
    const D: [f32; 2] = [0.110_383_18, 0.000_921_583_73];
    if !magnitude_between(x, SMALL, SATURATED) {
        // In line, for a call would have every caller's loop save its constants.
        let one = f32::from_bits(1.0_f32.to_bits() | (x.to_bits() & 0x8000_0000));
        return if abs(x) >= SATURATED { one } else { x };
    }
    let z = x * x;
    let n = x * ((N[1] * z + N[0]) * z + 1.0);
    let d = (D[1] * z + D[0]) * z + 1.0;
    n * d / (0.25 * (n * n) + d * d)
}

/// Bipolar sigmoid 2/(1 + e^(−A x)) − 1 = tanh(A x / 2), with gradient coefficient A (Nicol, Ellery and Cloutis, equation 13).
///
/// Defined for every f32, ±∞ included; errors, bounds and symmetry are those of [`tanh`], and the rounding of A·x adds less
/// than 3·10⁻⁸. NaN in either argument, or 0 · ∞, gives NaN.
#[inline]
pub fn bipolar_sigmoid(x: f32, gradient: f32) -> f32 {
    tanh(0.5 * gradient * x)
}

#[cfg(test)]
mod tests {
    use super::{bipolar_sigmoid, tanh};

    #[test]
    fn special_values() {
        assert_eq!(tanh(0.0).to_bits(), 0);
        assert_eq!(tanh(-0.0).to_bits(), (-0.0_f32).to_bits());
        assert_eq!(tanh(f32::from_bits(3)), f32::from_bits(3));
        assert_eq!(tanh(8.0), 1.0);
        assert_eq!(tanh(-8.0), -1.0);
        assert_eq!(tanh(f32::MAX), 1.0);
        assert_eq!(tanh(f32::INFINITY), 1.0);
        assert_eq!(tanh(f32::NEG_INFINITY), -1.0);
        assert!(tanh(f32::NAN).is_nan());
    }

    #[test]
    fn sigmoid_is_the_formula_of_equation_13() {
        for gradient in [0.1_f32, 1.0, 2.0 / 3.0, 5.0] {
            for step in -400_i16..=400 {
                let x = f32::from(step) * 0.05;
                let exact = 2.0 / (1.0 + (-f64::from(gradient) * f64::from(x)).exp()) - 1.0;
                let error = f64::from(bipolar_sigmoid(x, gradient)) - exact;
                assert!(error.abs() <= 4e-7, "A = {gradient}, x = {x}: {error:e}");
            }
        }
        assert_eq!(bipolar_sigmoid(f32::NEG_INFINITY, 1.0), -1.0);
        assert!(bipolar_sigmoid(f32::NAN, 1.0).is_nan());
    }
}
