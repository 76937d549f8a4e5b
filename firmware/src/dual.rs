//! Numbers that carry their derivatives, so that the wheel–soil equations give their slopes as they are computed.

use core::cmp::Ordering;
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use crate::scalar::{Scalar, Tabulated};

/// A value and its derivatives by N variables. Comparisons look at the value alone.
#[derive(Debug, Clone, Copy)]
pub struct Dual<S, const N: usize> {
    /// The value.
    pub value: S,
    /// The derivatives.
    pub slopes: [S; N],
}

impl<S: Scalar, const N: usize> Dual<S, N> {
    /// The variable at the given place.
    pub fn variable(value: S, place: usize) -> Self {
        Self { value, slopes: core::array::from_fn(|k| if k == place { S::one() } else { S::zero() }) }
    }

    /// A number that depends on no variable.
    pub fn fixed(value: S) -> Self {
        Self { value, slopes: [S::zero(); N] }
    }

    /// A function of this number alone, by its value and its derivative.
    #[inline(always)]
    fn through(mut self, value: S, derivative: S) -> Self {
        self.value = value;
        for slope in &mut self.slopes {
            *slope = derivative * *slope;
        }
        self
    }

    /// A function of two numbers, by its value and its derivatives.
    #[inline(always)]
    fn of_two(mut self, other: &Self, value: S, by_self: S, by_other: S) -> Self {
        self.value = value;
        for (slope, other) in self.slopes.iter_mut().zip(&other.slopes) {
            *slope = by_self * *slope + by_other * *other;
        }
        self
    }
}

impl<S: Scalar, const N: usize> PartialEq for Dual<S, N> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<S: Scalar, const N: usize> PartialOrd for Dual<S, N> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<S: Scalar, const N: usize> Add for Dual<S, N> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl<S: Scalar, const N: usize> Sub for Dual<S, N> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, other: Self) -> Self {
        self -= other;
        self
    }
}

impl<S: Scalar, const N: usize> Mul for Dual<S, N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (value, by_self, by_other) = (self.value * other.value, other.value, self.value);
        self.of_two(&other, value, by_self, by_other)
    }
}

impl<S: Scalar, const N: usize> Div for Dual<S, N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let (value, inverse) = (self.value / other.value, S::one() / other.value);
        self.of_two(&other, value, inverse, -value * inverse)
    }
}

impl<S: Scalar, const N: usize> Neg for Dual<S, N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.through(-self.value, -S::one())
    }
}

impl<S: Scalar, const N: usize> AddAssign for Dual<S, N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        self.value += other.value;
        for (slope, other) in self.slopes.iter_mut().zip(&other.slopes) {
            *slope += *other;
        }
    }
}

impl<S: Scalar, const N: usize> SubAssign for Dual<S, N> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        self.value -= other.value;
        for (slope, other) in self.slopes.iter_mut().zip(&other.slopes) {
            *slope -= *other;
        }
    }
}

impl<S: Scalar, const N: usize> Scalar for Dual<S, N> {
    type Plain = S;

    const EPSILON: f64 = S::EPSILON;
    // Fewer slopes than this are carried through every operation in less time.
    const IS_CHAINED: bool = N > 3;

    fn plain(self) -> S {
        self.value
    }
    fn from_plain(value: S) -> Self {
        Self::fixed(value)
    }
    #[inline(always)]
    fn scaled(self, factor: S) -> Self {
        self.through(self.value * factor, factor)
    }
    #[inline(always)]
    fn follow(&mut self, input: &Self, derivative: S) {
        for (slope, input) in self.slopes.iter_mut().zip(&input.slopes) {
            *slope += derivative * *input;
        }
    }
    fn constant(value: f64) -> Self {
        Self::fixed(S::constant(value))
    }
    fn tabulated(entry: &Tabulated) -> Self {
        Self::fixed(S::tabulated(entry))
    }
    fn from_f32(reading: f32) -> Self {
        Self::fixed(S::from_f32(reading))
    }
    fn to_f32(self) -> f32 {
        self.value.to_f32()
    }
    // The target has too few registers for a copy in every place that uses it.
    #[cfg_attr(not(target_os = "none"), inline(always))]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.through(sin, cos), self.through(cos, -sin))
    }
    /// At ±1, where the derivative is infinite, the slopes are zero: those of a constant.
    fn acos(self) -> Self {
        let sine = (S::one() - self.value * self.value).sqrt();
        self.through(self.value.acos(), if sine == S::zero() { S::zero() } else { -S::one() / sine })
    }
    #[inline(always)]
    fn exp(self) -> Self {
        let value = self.value.exp();
        self.through(value, value)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        self.through(self.value.ln(), S::one() / self.value)
    }
    /// At a base of zero the slopes are zero: those of an exponent above one.
    fn powf(self, exponent: Self) -> Self {
        if self.value == S::zero() {
            return Self::fixed(self.value.powf(exponent.value));
        }
        let value = self.value.powf(exponent.value);
        self.of_two(&exponent, value, value * exponent.value / self.value, value * self.value.ln())
    }
    /// At zero, where the derivative is infinite, the slopes are zero: those of a constant.
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.through(root, if root == S::zero() { S::zero() } else { S::constant(0.5) / root })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        if self.value < S::zero() { -self } else { self }
    }
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.slopes.iter().all(|slope| slope.is_finite())
    }
}
