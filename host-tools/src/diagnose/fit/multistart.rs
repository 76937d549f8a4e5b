//! Fits from many starts, so that the answer does not hang on one.

use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, Normal};

use super::model::{Coordinate, Model};
use super::observation::Row;
use super::options::{FitError, Options};
use super::outcome::{Fit, fit_without};
use super::start::Start;

/// Share of the bounds' width, and of the prior's probability, that starts keep away from either end.
const MARGIN: f64 = 0.05;

/// Fits to all rows but those of some runs from each start, in parallel: the fit of highest posterior, of equal ones the first.
///
/// # Errors
/// [`FitError::NoStart`] without a start, else the first start's error if no start came to a fit.
pub fn fit_from_many(
    model: &dyn Model,
    rows: &[Row],
    without: &[usize],
    starts: &[Start],
    options: &Options,
) -> Result<Fit, FitError> {
    let from = |start: &Start| fit_without(model, rows, without, start, options);
    let fits: Vec<Result<Fit, FitError>> = starts.par_iter().map(from).collect();
    let first_error = fits.iter().find_map(|fit| fit.as_ref().err().copied());
    let fits = fits.into_iter().flatten().filter(|fit| !fit.log_posterior.is_nan());
    let better = |best: Fit, fit: Fit| if fit.log_posterior > best.log_posterior { fit } else { best };
    fits.reduce(better).ok_or(first_error.unwrap_or(FitError::NoStart))
}

/// The model's own start, then more that fill its prior evenly (Sobol's sequence; a bound at infinity keeps the own start).
pub fn scattered_starts(model: &dyn Model, rows: &[Row], count: usize, seed: u32) -> Vec<Start> {
    let scattered = (1..count as u32).map(|index| {
        let place = |(axis, coordinate): (usize, &Coordinate)| {
            let share = f64::from(sobol_burley::sample(index, axis as u32, seed));
            quantile(coordinate, MARGIN + (1.0 - 2.0 * MARGIN) * share)
        };
        Start::at(model.coordinates().iter().enumerate().map(place).collect(), rows)
    });
    std::iter::once(Start::of(model, rows)).take(count).chain(scattered).collect()
}

fn quantile(coordinate: &Coordinate, share: f64) -> f64 {
    let value = match coordinate.prior {
        Some((mean, std)) => Normal::new(mean, std).map_or(mean, |normal| normal.inverse_cdf(share)),
        None if coordinate.box_precision() > 0.0 => coordinate.low + share * (coordinate.high - coordinate.low),
        None => coordinate.start,
    };
    value.clamp(coordinate.low, coordinate.high)
}
