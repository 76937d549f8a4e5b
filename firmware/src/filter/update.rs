//! The estimate after measurements.
//!
//! With x = m + S ξ, ξ of unit covariance, a measurement is y = ŷ + Yᵀξ + noise, where row i of Y holds the slopes along
//! column i of S, and the noise has the covariance R′ = R + (bends)². Whitened by the root of R′, the information on ξ is
//! I + Y Yᵀ = TᵀT, T from reflections of Yᵀ onto the unit matrix: its diagonal is at least one whatever Y is. The new root
//! is S T⁻¹, and the whitened innovation, reflected along, splits into what moves the mean and what no state explains.

use core::array::from_fn;

use crate::scalar::Scalar;

use super::reflection::Reflection;
use super::transform::{Output, transform};
use super::vector::{dot, scale, subtract};
use super::{Fate, Fusion, Gate, Gaussian, Innovation, Residual, SigmaPointFilter};

/// The least standard deviation of a measurement's noise: the square of less is lost in single precision.
const LEAST_NOISE: f64 = 1e-18;

impl<T: Scalar, const N: usize> SigmaPointFilter<T, N> {
    /// Takes in measurements, each of which may be missing, with independent noise of these standard deviations.
    ///
    /// Every measurement is gated by itself, against what was expected before any was taken in. One that is missing, rejected or
    /// not finite changes nothing: the estimate is, to the bit, that of a filter without this measurement.
    ///
    /// Cost: 2 N + 1 evaluations of the model, about 1.5 N M² + N² M + N³/2 multiplications with addition.
    pub fn update<const M: usize>(
        &mut self,
        model: impl Fn(&[T; N]) -> [T; M],
        measured: &[Option<T>; M],
        noise_std: &[T; M],
        gate: Gate<T>,
    ) -> Innovation<T, M> {
        let mut expected = [Output::blank(); M];
        transform(&self.estimate, &self.factors, &model, &mut expected);
        let residuals = judge(&mut expected, measured, noise_std, gate);
        let degrees_of_freedom = residuals.iter().filter(|residual| residual.fate == Fate::Used).count();
        let mut told =
            Innovation { fusion: Fusion::NothingToFuse, residuals, normalised_square: T::zero(), degrees_of_freedom };
        if degrees_of_freedom == 0 {
            return told;
        }
        let (mean, normalised_square) = fuse(&mut self.estimate, &mut expected, &told.residuals, noise_std);
        if self.settle(mean, normalised_square) {
            (told.fusion, told.normalised_square) = (Fusion::Done, normalised_square);
        } else {
            (told.fusion, told.degrees_of_freedom) = (Fusion::Reset, 0);
        }
        told
    }
}

/// What becomes of each measurement. One that is not used loses its deviations: it then carries no information.
#[inline]
fn judge<T: Scalar, const N: usize, const M: usize>(
    expected: &mut [Output<T, N>; M],
    measured: &[Option<T>; M],
    noise_std: &[T; M],
    gate: Gate<T>,
) -> [Residual<T>; M] {
    let mut residuals = [Residual { fate: Fate::Missing, innovation: T::zero(), std: T::zero() }; M];
    for (((residual, output), measured), noise) in residuals.iter_mut().zip(expected).zip(measured).zip(noise_std) {
        let mean = output.mean;
        let deviations = output.rows();
        let variance = *noise * *noise + dot(deviations, deviations);
        *residual = residual_of(*measured, mean, variance.sqrt(), *noise, gate);
        if residual.fate != Fate::Used {
            deviations.fill(T::zero());
        }
    }
    residuals
}

#[inline]
fn residual_of<T: Scalar>(measured: Option<T>, mean: T, std: T, noise: T, gate: Gate<T>) -> Residual<T> {
    let known = mean.is_finite() && std.is_finite() && noise >= T::constant(LEAST_NOISE);
    let std = if known { std } else { T::zero() };
    let without = |fate| Residual { fate, innovation: T::zero(), std };
    let Some(measured) = measured else { return without(Fate::Missing) };
    let innovation = measured - mean;
    if !(known && innovation.is_finite()) {
        return without(Fate::NotFinite);
    }
    let normalised = innovation / std;
    let fate = if gate.admits(normalised * normalised) { Fate::Used } else { Fate::Rejected };
    Residual { fate, innovation, std }
}

/// Brings the used measurements into the root; gives the mean that belongs to it and their joint squared innovation.
#[inline]
fn fuse<T: Scalar, const N: usize, const M: usize>(
    estimate: &mut Gaussian<T, N>,
    expected: &mut [Output<T, N>; M],
    residuals: &[Residual<T>; M],
    noise_std: &[T; M],
) -> ([T; N], T) {
    let mut innovations = whiten(expected, residuals, noise_std);
    let mut information = by_state(expected);
    let mut mean = estimate.mean;
    let (mut columns, mut root) = (information.as_mut_slice(), estimate.root.as_mut_slice());
    while let (Some((column, later)), Some((direction, later_directions))) =
        (columns.split_first_mut(), root.split_first_mut())
    {
        let (reflection, norm) = Reflection::new(T::one(), column);
        scale(direction, T::one() / norm);
        subtract(&mut mean, -reflection.apply(&mut innovations), direction);
        for (other, other_direction) in later.iter_mut().zip(later_directions.iter_mut()) {
            subtract(other_direction, reflection.apply(other), direction);
        }
        (columns, root) = (later, later_directions);
    }
    (mean, dot(&innovations, &innovations))
}

/// Brings the slopes to units of the joint noise, in which bends and measurement noise together are independent and of unit
/// size; gives the innovations in these units.
#[inline]
fn whiten<T: Scalar, const N: usize, const M: usize>(
    expected: &mut [Output<T, N>; M],
    residuals: &[Residual<T>; M],
    noise_std: &[T; M],
) -> [T; M] {
    let mut whitened = residuals.map(|residual| residual.used());
    let (mut outputs, mut innovations) = (expected.as_mut_slice(), whitened.as_mut_slice());
    for (noise, residual) in noise_std.iter().zip(residuals) {
        let Some((output, later)) = outputs.split_first_mut() else { break };
        let Some((innovation, later_innovations)) = innovations.split_first_mut() else { break };
        let [slopes, bends] = &mut output.deviations;
        let pivot = if residual.fate == Fate::Used { *noise } else { T::one() };
        let (reflection, norm) = Reflection::new(pivot, bends);
        let unit = T::one() / norm;
        scale(slopes, unit);
        *innovation = *innovation * unit;
        for (other, other_innovation) in later.iter_mut().zip(later_innovations.iter_mut()) {
            let [other_slopes, other_bends] = &mut other.deviations;
            let share = reflection.apply(other_bends);
            subtract(other_slopes, share, slopes);
            *other_innovation -= share * *innovation;
        }
        (outputs, innovations) = (later, later_innovations);
    }
    whitened
}

/// The slopes of all outputs along each column of the root.
#[inline]
fn by_state<T: Scalar, const N: usize, const M: usize>(outputs: &[Output<T, N>; M]) -> [[T; M]; N] {
    let slope = |output: &Output<T, N>, state: usize| {
        let [slopes, _] = &output.deviations;
        slopes.get(state).copied()
    };
    from_fn(|state| from_fn(|m| outputs.get(m).and_then(|output| slope(output, state)).unwrap_or_else(T::zero)))
}
