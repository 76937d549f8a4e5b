//! The estimate after measurements.
//!
//! With x = m + S ξ, ξ of unit covariance, a measurement is y = ŷ + Yᵀξ + noise, where row i of Y holds the slopes along
//! column i of S, and the noise has the covariance R′ = R + (bends)². Whitened by the root of R′, the information on ξ is
//! I + Y Yᵀ = TᵀT, T from reflections of Y onto the unit matrix: its diagonal is at least one whatever Y is. The new root
//! is S T⁻¹, and the whitened innovation, reflected along, splits into what moves the mean and what no state explains.

use crate::scalar::Scalar;

use super::gaussian::dot;
use super::reflection::{divide_by_triangle, triangularise};
use super::transform::Transformed;
use super::{Fate, Fusion, Gate, Gaussian, Innovation, Residual, SigmaPointFilter};

impl<T: Scalar, const N: usize> SigmaPointFilter<T, N> {
    /// Takes in measurements, each of which may be missing, with independent noise of these standard deviations (> 0).
    ///
    /// Every measurement is gated by itself, against what was expected before any was taken in. One that is missing, rejected or
    /// not finite changes nothing: the estimate is, to the bit, that of a filter without this measurement.
    ///
    /// Cost: 2 N + 1 evaluations of the model, about 2 N M² + N² M + N³/6 multiplications with addition.
    pub fn update<const M: usize>(
        &mut self,
        model: impl Fn(&[T; N]) -> [T; M],
        measured: &[Option<T>; M],
        noise_std: &[T; M],
        gate: Gate<T>,
    ) -> Innovation<T, M> {
        let mut expected = Transformed::new(&self.estimate, &self.factors, &model);
        let residuals = judge(&mut expected, measured, noise_std, gate);
        let degrees_of_freedom = residuals.iter().filter(|residual| residual.fate == Fate::Used).count();
        let mut told =
            Innovation { fusion: Fusion::NothingToFuse, residuals, normalised_square: T::zero(), degrees_of_freedom };
        if degrees_of_freedom == 0 {
            return told;
        }
        let (estimate, normalised_square) = fuse(&self.estimate, &expected, &residuals, noise_std);
        if self.accept(estimate, normalised_square) {
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
    expected: &mut Transformed<T, N, M>,
    measured: &[Option<T>; M],
    noise_std: &[T; M],
    gate: Gate<T>,
) -> [Residual<T>; M] {
    let mut residuals = [Residual { fate: Fate::Missing, innovation: T::zero(), std: T::zero() }; M];
    let expectations = expected.mean.iter().zip(&mut expected.deviations);
    for (((residual, (mean, deviations)), measured), noise) in
        residuals.iter_mut().zip(expectations).zip(measured).zip(noise_std)
    {
        let variance = *noise * *noise + dot(deviations.as_flattened(), deviations.as_flattened());
        *residual = residual_of(*measured, *mean, variance.sqrt(), *noise, gate);
        if residual.fate != Fate::Used {
            *deviations = [[T::zero(); N]; 2];
        }
    }
    residuals
}

#[inline]
fn residual_of<T: Scalar>(measured: Option<T>, mean: T, std: T, noise: T, gate: Gate<T>) -> Residual<T> {
    let known = mean.is_finite() && std.is_finite() && noise > T::zero();
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

/// The estimate with the used measurements in it, and their joint squared innovation.
#[inline]
fn fuse<T: Scalar, const N: usize, const M: usize>(
    prior: &Gaussian<T, N>,
    expected: &Transformed<T, N, M>,
    residuals: &[Residual<T>; M],
    noise_std: &[T; M],
) -> (Gaussian<T, N>, T) {
    let (slopes, mut innovations) = whiten(expected, residuals, noise_std);
    // The last state first: S T⁻¹ is then triangular as S is.
    let mut columns = [[[T::zero(); M]; 1]; N];
    for (index, row) in slopes.iter().enumerate() {
        for ([column], slope) in columns.iter_mut().rev().zip(row) {
            if let Some(place) = column.get_mut(index) {
                *place = *slope;
            }
        }
    }
    let information = triangularise(&[T::one(); N], &mut columns, &mut innovations);
    let mut posterior = *prior;
    posterior.root.reverse();
    divide_by_triangle(&mut posterior.root, &information.root);
    for (column, share) in posterior.root.iter().zip(&information.beside) {
        posterior.mean.iter_mut().zip(column).for_each(|(place, entry)| *place += *share * *entry);
    }
    posterior.root.reverse();
    (posterior, dot(&innovations, &innovations))
}

/// Slopes and innovations in units of the joint noise: the bends and the measurement noise become independent and of unit size.
#[inline]
fn whiten<T: Scalar, const N: usize, const M: usize>(
    expected: &Transformed<T, N, M>,
    residuals: &[Residual<T>; M],
    noise_std: &[T; M],
) -> ([[T; N]; M], [T; M]) {
    let mut pivots = *noise_std;
    let mut innovations = [[T::zero()]; M];
    for ((pivot, [place]), residual) in pivots.iter_mut().zip(&mut innovations).zip(residuals) {
        if residual.fate == Fate::Used {
            *place = residual.innovation;
        } else {
            *pivot = T::one();
        }
    }
    let mut slopes = expected.deviations.map(|[slopes, _]| slopes);
    let noise = triangularise(&pivots, &mut expected.deviations.map(|[_, bends]| [bends]), &mut []).root;
    divide_by_triangle(&mut slopes, &noise);
    divide_by_triangle(&mut innovations, &noise);
    (slopes, innovations.map(|[innovation]| innovation))
}
