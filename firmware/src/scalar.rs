//! The number that the equations are written in: `f32` in flight, `f64` on the host, dual numbers where the host
//! wants derivatives.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use crate::math;

/// A real number with the elementary functions that the wheel–soil equations need.
///
/// Each implementation gives the same bits on every target: `f64` has those of `libm`, `f32` calls [`crate::math`].
pub trait Scalar:
    Copy
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + 'static
{
    /// The number without what it carries along: itself, but for a dual number, which is a plain value with slopes.
    type Plain: Scalar;

    /// The distance from one to the next number: what a computation can hope for. That of `f64` unless said otherwise.
    const EPSILON: f64 = f64::EPSILON;
    /// Whether it carries so much that a long computation is done sooner on plain values, with the derivatives by what it
    /// starts from, and these then given to [`Scalar::follow`].
    const IS_CHAINED: bool = false;

    /// The value alone.
    fn plain(self) -> Self::Plain;
    /// A number that carries nothing but the value.
    fn from_plain(value: Self::Plain) -> Self;
    /// This number times a plain value.
    fn scaled(self, factor: Self::Plain) -> Self;
    /// Lets what this number carries follow what `input` carries: the chain rule's term of an input by which the value has
    /// this derivative. A plain number carries nothing and stays as it is.
    fn follow(&mut self, input: &Self, derivative: Self::Plain);

    /// The nearest number to a constant of the equations.
    fn constant(value: f64) -> Self;
    /// The nearest number to an entry of a table.
    fn tabulated(entry: &Tabulated) -> Self {
        Self::constant(entry.double)
    }
    /// The number that a sensor gave.
    fn from_f32(reading: f32) -> Self {
        Self::constant(f64::from(reading))
    }
    /// The nearest single-precision number.
    fn to_f32(self) -> f32;
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// Arc cosine in radians; NaN outside −1 … 1.
    fn acos(self) -> Self;
    /// e to the power of `self`.
    fn exp(self) -> Self;
    /// Natural logarithm; NaN below zero.
    fn ln(self) -> Self;
    /// `self` to the power of `exponent`, for a base of zero or more.
    fn powf(self, exponent: Self) -> Self;
    /// Square root; NaN below zero.
    fn sqrt(self) -> Self;
    /// Magnitude.
    fn abs(self) -> Self;
    /// Neither NaN nor infinite.
    fn is_finite(self) -> bool;

    /// Sine of an angle in radians.
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    /// Cosine of an angle in radians.
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// The lesser of two numbers.
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }
    /// The greater of two numbers.
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }
    /// Zero.
    fn zero() -> Self {
        Self::constant(0.0)
    }
    /// One.
    fn one() -> Self {
        Self::constant(1.0)
    }
}

/// An entry of a table of constants, held in both precisions: single precision then converts nothing at run time, which
/// would cost more than the arithmetic on a processor without double precision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tabulated {
    double: f64,
    single: f32,
}

impl Tabulated {
    /// The entry that is nearest to `value` in each precision.
    pub const fn new(value: f64) -> Self {
        Self { double: value, single: value as f32 }
    }
}

/// The part of [`Scalar`] that is about derivatives, for a number that has none.
macro_rules! without_derivatives {
    () => {
        type Plain = Self;

        fn plain(self) -> Self {
            self
        }
        fn from_plain(value: Self) -> Self {
            value
        }
        fn scaled(self, factor: Self) -> Self {
            self * factor
        }
        fn follow(&mut self, _input: &Self, _derivative: Self) {}
    };
}

impl Scalar for f64 {
    without_derivatives!();

    fn constant(value: f64) -> Self {
        value
    }
    fn to_f32(self) -> f32 {
        self as f32
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        math::double::sin_cos(self)
    }
    fn acos(self) -> Self {
        libm::acos(self)
    }
    #[inline]
    fn exp(self) -> Self {
        math::double::exp(self)
    }
    #[inline]
    fn ln(self) -> Self {
        math::double::ln(self)
    }
    fn powf(self, exponent: Self) -> Self {
        libm::pow(self, exponent)
    }
    fn sqrt(self) -> Self {
        libm::sqrt(self)
    }
    fn abs(self) -> Self {
        libm::fabs(self)
    }
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
}

impl Scalar for f32 {
    without_derivatives!();

    const EPSILON: f64 = f32::EPSILON as f64;

    fn constant(value: f64) -> Self {
        value as f32
    }
    fn from_f32(reading: f32) -> Self {
        reading
    }
    fn to_f32(self) -> f32 {
        self
    }
    fn tabulated(entry: &Tabulated) -> Self {
        entry.single
    }
    fn sin_cos(self) -> (Self, Self) {
        math::sin_cos_of_slope(self)
    }
    fn acos(self) -> Self {
        math::acos(self)
    }
    fn exp(self) -> Self {
        math::exp(self)
    }
    fn ln(self) -> Self {
        math::ln(self)
    }
    fn powf(self, exponent: Self) -> Self {
        math::powf(self, exponent)
    }
    fn sqrt(self) -> Self {
        math::sqrt(self)
    }
    fn abs(self) -> Self {
        math::abs(self)
    }
    fn is_finite(self) -> bool {
        f32::is_finite(self)
    }
}
