//! Columns that say of the contact of wheel and soil again what slip, load and the channels say: no causes.

use kapvik_firmware::terramechanics::effects::speed_ratio;
use nalgebra::{DMatrix, DVector};

use crate::data::campaign::Channel;

use super::fit::{Latent, Reading};
use super::measurements::Measurements;
use super::noise::Noise;

/// Share of a column's variance which slip and load make, beyond which it says no more than they do.
const SAYS_NO_MORE: f64 = 0.99;
/// Least v/(rω) that counts there: a wheel may spin on the spot.
const LEAST_RATIO: f64 = 0.02;
/// What a straight line in a column leaves of a channel that it measures again, in standard deviations of the channel's noise.
const LEFT_AGAIN: f64 = 2.0;
/// Scatter of a channel by slip and load, in the same, from which such a line says anything.
const MOVED: f64 = 6.0;
/// Fewest rows with both.
const LEAST_ROWS: usize = 8;

/// Whether a column is a smooth function of slip and load in these rows. The share of its variance counts by degrees of freedom.
pub fn says_no_more(values: &[Option<f64>], latents: &[Latent]) -> bool {
    by_state(values, latents).is_some_and(|ByState { known, fitted, terms }| {
        let left = (&known - fitted).norm_squared() / (known.len() - terms) as f64;
        left < (1.0 - SAYS_NO_MORE) * known.variance()
    })
}

/// Whether a column that the format does not name measures a channel again. Those that it names are causes, whatever a channel may do beside
/// them.
pub fn is_second_sensor(name: &str, values: &[Option<f64>], measurements: &Measurements, latents: &[Latent]) -> bool {
    let measured = [Reading::Sinkage, Reading::DrawbarPull, Reading::Torque, Reading::Load];
    let measures_again = |reading: Reading| {
        let channel = reading.index();
        let readings: Vec<Option<f64>> = measurements.rows.iter().map(|row| row.readings[channel]).collect();
        let Noise { std, of_repeats, .. } = measurements.noise[channel];
        let noise = of_repeats.map_or(std, |of_repeats| of_repeats.min(std));
        says_again(values, &readings, noise, latents)
    };
    Channel::from_name(name).is_none() && measured.into_iter().any(measures_again)
}

/// Whether a straight line in a column is a channel's readings but for their noise. Slip and load must move the channel: what is still but for
/// what a column does to it would follow that column as well.
fn says_again(values: &[Option<f64>], readings: &[Option<f64>], noise: f64, latents: &[Latent]) -> bool {
    let is_moved =
        || by_state(readings, latents).is_some_and(|state| state.fitted.variance() > (MOVED * noise).powi(2));
    beside_line(values, readings).is_some_and(|left| left <= (LEFT_AGAIN * noise).powi(2)) && is_moved()
}

/// The variance of some readings about a straight line in a column, by degrees of freedom; none of few rows, or of a column that does not vary.
fn beside_line(values: &[Option<f64>], readings: &[Option<f64>]) -> Option<f64> {
    let both = values.iter().zip(readings).filter_map(|(value, reading)| Some(((*value)?, (*reading)?)));
    let (values, readings): (Vec<f64>, Vec<f64>) =
        both.filter(|(value, reading)| value.is_finite() && reading.is_finite()).unzip();
    if values.len() < LEAST_ROWS {
        return None;
    }
    let about_mean = |numbers: Vec<f64>| {
        let numbers = DVector::from(numbers);
        numbers.add_scalar(-numbers.mean())
    };
    let (values, readings) = (about_mean(values), about_mean(readings));
    let slope = values.dot(&readings) / values.norm_squared();
    slope.is_finite().then(|| (&readings - values * slope).norm_squared() / (readings.len() - 2) as f64)
}

/// A column in the rows that have it, and what slip and load make of it.
struct ByState {
    known: DVector<f64>,
    fitted: DVector<f64>,
    /// Coefficients of that.
    terms: usize,
}

/// By least squares: a straight line in the load, and in the slip a parabola and what rates and speeds go with, 1/(1 − i). None of few rows.
fn by_state(values: &[Option<f64>], latents: &[Latent]) -> Option<ByState> {
    let of_state = |Latent { slip, load_n, .. }: &Latent| {
        [1.0, *slip, slip * slip, speed_ratio(*slip).max(LEAST_RATIO).recip(), *load_n]
    };
    let known = values.iter().zip(latents).filter_map(|(value, latent)| Some(((*value)?, of_state(latent))));
    let (known, states): (Vec<f64>, Vec<[f64; 5]>) = known.filter(|(value, _)| value.is_finite()).unzip();
    let terms = states.first().map_or(0, |state| state.len());
    if known.len() < 2 * terms || terms == 0 {
        return None;
    }
    let states = DMatrix::from_fn(known.len(), terms, |row, term| states[row][term]);
    let known = DVector::from(known);
    let singular = 1e-9 * states.amax();
    let factors = states.clone().svd(true, true).solve(&known, singular).ok()?;
    Some(ByState { fitted: states * factors, known, terms })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rate_of_a_wheel_says_no_more_than_its_slip_where_its_carriage_keeps_its_speed() {
        let slips = (0..15).map(|row| 0.1 + 0.2 * f64::from(row % 5));
        let latents: Vec<Latent> = slips.map(|slip| Latent { slip, load_n: 25.0, sinkage_m: 0.01 }).collect();
        let values = |of: &dyn Fn(usize, f64) -> f64| -> Vec<Option<f64>> {
            latents.iter().enumerate().map(|(row, latent)| Some(of(row, latent.slip))).collect()
        };
        let at_one_speed = values(&|row, slip| (0.16 + 0.001 * (row % 2) as f64) / (1.0 - slip));
        let at_two_speeds = values(&|row, slip| if row < 7 { 0.16 } else { 0.32 } / (1.0 - slip));
        let with_the_hours = values(&|row, _| row as f64);
        let of = |values: &[Option<f64>]| says_no_more(values, &latents);
        assert_eq!([at_one_speed, at_two_speeds, with_the_hours].map(|values| of(&values)), [true, false, false]);
        assert!(!says_no_more(&[Some(1.0); 3], &latents[..3]), "of three rows nobody knows");
    }

    /// A laser beside the sensor of the sinkage, in millimetres from its own zero. Hours, and sand that is wet by turns, are no second sensor,
    /// though the sinkage goes with them where nothing else moves it.
    #[test]
    fn a_second_sensor_is_told_from_a_cause() {
        const NOISE_M: f64 = 3e-4;
        let scatter = |row: usize| ((4 * row) % 7) as f64 / 3.0 - 1.0;
        let wet = |row: usize| (row / 2 % 2) as f64;
        let latents = |moves: bool| -> Vec<Latent> {
            let place = |row: usize| if moves { ((row % 5) as f64, (row / 5) as f64) } else { (2.0, 1.0) };
            let at = |(slip, load): (f64, f64)| Latent {
                slip: 0.1 + 0.2 * slip,
                load_n: 25.0 + 25.0 * load,
                sinkage_m: 0.01,
            };
            (0..15).map(|row| at(place(row))).collect()
        };
        let column = |of: &dyn Fn(usize) -> f64| -> Vec<Option<f64>> { (0..15).map(|row| Some(of(row))).collect() };
        let moved = latents(true);
        let true_m = |row: usize| 0.001 + 0.01 * moved[row].slip + 2e-4 * moved[row].load_n;
        let sinkage_m = column(&|row| true_m(row) + NOISE_M * scatter(row));
        let laser_mm = column(&|row| 2.0 + 1e3 * (true_m(row) + 0.1 * NOISE_M * scatter(row + 3)));
        let [hours, wet_sand] = [column(&|row| row as f64), column(&wet)];
        let again = |values: &[Option<f64>]| says_again(values, &sinkage_m, NOISE_M, &moved);
        assert_eq!([&laser_mm, &hours, &wet_sand].map(|values| again(values)), [true, false, false]);
        let of_wet_sand = column(&|row| 0.01 + 0.01 * wet(row) + NOISE_M * scatter(row));
        assert!(!says_again(&wet_sand, &of_wet_sand, NOISE_M, &latents(false)), "nothing but the water moves it");
        assert!(!says_again(&laser_mm[..7], &sinkage_m[..7], NOISE_M, &moved[..7]), "of seven rows nobody knows");
    }
}
