//! Numbers that carry their derivatives, so that the wheel–soil equations give their slopes as they are computed.

use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use kapvik_firmware::scalar::Scalar;

/// A value and its derivatives by N variables. Comparisons look at the value alone.
#[derive(Debug, Clone, Copy)]
pub struct Dual<const N: usize> {
    /// The value.
    pub value: f64,
    /// The derivatives.
    pub slopes: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// The variable at the given place.
    pub fn variable(value: f64, place: usize) -> Self {
        Self { value, slopes: std::array::from_fn(|k| if k == place { 1.0 } else { 0.0 }) }
    }

    /// A function of this number alone, by its value and its derivative.
    fn through(self, value: f64, derivative: f64) -> Self {
        Self { value, slopes: self.slopes.map(|slope| derivative * slope) }
    }

    /// A function of two numbers, by its value and its derivatives.
    fn of_two(self, other: Self, value: f64, by_self: f64, by_other: f64) -> Self {
        let mut slopes = [0.0; N];
        for (slope, (a, b)) in slopes.iter_mut().zip(self.slopes.iter().zip(&other.slopes)) {
            *slope = by_self * a + by_other * b;
        }
        Self { value, slopes }
    }
}

impl<const N: usize> PartialEq for Dual<N> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<const N: usize> PartialOrd for Dual<N> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.of_two(other, self.value + other.value, 1.0, 1.0)
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.of_two(other, self.value - other.value, 1.0, -1.0)
    }
}

impl<const N: usize> Mul for Dual<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.of_two(other, self.value * other.value, other.value, self.value)
    }
}

impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let (value, inverse) = (self.value / other.value, 1.0 / other.value);
        self.of_two(other, value, inverse, -value * inverse)
    }
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;
    fn neg(self) -> Self {
        self.through(-self.value, -1.0)
    }
}

impl<const N: usize> AddAssign for Dual<N> {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const N: usize> SubAssign for Dual<N> {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<const N: usize> Scalar for Dual<N> {
    fn constant(value: f64) -> Self {
        Self { value, slopes: [0.0; N] }
    }
    fn to_f32(self) -> f32 {
        self.value as f32
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.through(sin, cos), self.through(cos, -sin))
    }
    /// At ±1, where the derivative is infinite, the slopes are zero: those of a constant.
    fn acos(self) -> Self {
        let sine = (1.0 - self.value * self.value).sqrt();
        self.through(self.value.acos(), if sine == 0.0 { 0.0 } else { -1.0 / sine })
    }
    fn exp(self) -> Self {
        let value = self.value.exp();
        self.through(value, value)
    }
    fn ln(self) -> Self {
        self.through(self.value.ln(), 1.0 / self.value)
    }
    /// At a base of zero the slopes are zero: those of an exponent above one.
    fn powf(self, exponent: Self) -> Self {
        if self.value == 0.0 {
            return Self::constant(self.value.powf(exponent.value));
        }
        let value = self.value.powf(exponent.value);
        self.of_two(exponent, value, value * exponent.value / self.value, value * self.value.ln())
    }
    /// At zero, where the derivative is infinite, the slopes are zero: those of a constant.
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.through(root, if root == 0.0 { 0.0 } else { 0.5 / root })
    }
    fn abs(self) -> Self {
        if self.value < 0.0 { -self } else { self }
    }
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.slopes.iter().all(|slope| slope.is_finite())
    }
}
