//! Problems that the filter is measured, fingerprinted and compared with: cheap models, so that what counts is the filter.
//!
//! A ring of states, each drawn to the next and back to zero by a cubic spring; each is measured, with a cubic of itself,
//! and the measurements beyond the first `N` see the next state as well.

use core::ops::{Add, Mul, Sub};

use crate::scalar::Scalar;

/// How uncertain and how noisy, as standard deviations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    /// Of a state at the start.
    pub start_std: f32,
    /// Of the noise of a state in a step.
    pub process_std: f32,
    /// Of the noise of a measurement.
    pub noise_std: f32,
}

impl Scales {
    /// A tracking problem: what is known at the start is worth a few measurements.
    pub const NOMINAL: Self = Self { start_std: 0.5, process_std: 0.02, noise_std: 0.1 };
    /// A start of which nothing is known, and sensors 10¹⁰ times better in variance: what costs single precision its digits.
    pub const STIFF: Self = Self { start_std: 0.5, process_std: 1e-6, noise_std: 5e-6 };
}

/// Where the states are a step later.
#[inline]
pub fn process<T: Scalar, const N: usize>(x: &[T; N]) -> [T; N] {
    process_in(T::constant, x)
}

/// [`process`], in any arithmetic that has the four operators; `constant` gives its nearest number to one of the equations.
#[inline]
pub fn process_in<T: Arithmetic, const N: usize>(constant: impl Fn(f64) -> T, x: &[T; N]) -> [T; N] {
    let mut later = *x;
    for (place, next) in later.iter_mut().zip(x.iter().skip(1).chain(x)) {
        let here = *place;
        *place = here + constant(0.05) * (*next - here - here * here * here);
    }
    later
}

/// What is measured of the states, without noise.
#[inline]
pub fn measurement<T: Scalar, const N: usize, const M: usize>(x: &[T; N]) -> [T; M] {
    measurement_in(T::constant, x)
}

/// [`measurement`], in any arithmetic, as [`process_in`].
#[inline]
pub fn measurement_in<T: Arithmetic, const N: usize, const M: usize>(
    constant: impl Fn(f64) -> T,
    x: &[T; N],
) -> [T; M] {
    let mut measured = [constant(0.0); M];
    let mut share = constant(0.0);
    for places in measured.chunks_mut(N) {
        for ((place, here), next) in places.iter_mut().zip(x).zip(x.iter().skip(1).chain(x)) {
            *place = *here + share * *next + constant(0.1) * *here * *here * *here;
        }
        share = share + constant(1.0);
    }
    measured
}

/// What the models compute with: the filters that we compare with have numbers of their own.
pub trait Arithmetic: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>> Arithmetic for T {}

/// A run of the problem in single precision: the states as they truly are, and what is measured of them.
#[derive(Debug, Clone)]
pub struct Trial<const N: usize, const M: usize> {
    scales: Scales,
    truth: [f32; N],
    random: u32,
}

impl<const N: usize, const M: usize> Trial<N, M> {
    /// The run of a seed above zero.
    pub fn new(seed: u32, scales: Scales) -> Self {
        let mut trial = Self { scales, truth: [0.0; N], random: seed };
        trial.truth = [0.0; N].map(|zero| zero + scales.start_std * trial.noise());
        trial
    }

    /// The true states, those that the last measurements were made of.
    pub fn truth(&self) -> &[f32; N] {
        &self.truth
    }

    /// The next step's measurements.
    pub fn measure(&mut self) -> [f32; M] {
        let moved: [f32; N] = process(&self.truth);
        self.truth = moved.map(|state| state + self.scales.process_std * self.noise());
        let exact: [f32; M] = measurement(&self.truth);
        exact.map(|value| value + self.scales.noise_std * self.noise())
    }

    /// A number that is nearly normal, of mean zero and variance one: the sum of twelve uniform ones, less six.
    fn noise(&mut self) -> f32 {
        (0..12).fold(-6.0, |sum, _| sum + self.uniform())
    }

    /// Marsaglia's xorshift, 32 bits (2003, J. Stat. Software 8:14): 0 … 1.
    fn uniform(&mut self) -> f32 {
        self.random ^= self.random << 13;
        self.random ^= self.random >> 17;
        self.random ^= self.random << 5;
        (self.random >> 8) as f32 * f32::from_bits(0x3380_0000)
    }
}
