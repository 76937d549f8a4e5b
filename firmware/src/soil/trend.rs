//! How resistance, torque and contact angle go with slip and load over the wheels of an instant.
//!
//! Cohesion differs from friction in how little of the shear strength goes with the load, and K shows in how the torque
//! goes with slip, the more the heavier the wheel. These are differences among wheels, small beside what the wheels have
//! in common, and a network learns them slowly from the wheels one by one. A regression over the wheels says them
//! outright: the mean of the coefficients given the wheels and what is known of T/(rW) beforehand, each wheel counted by
//! how well its slip, load and torque are known.

use heapless::Vec;

use crate::math;
use crate::wheel_state::WHEELS;

use super::WheelFeatures;

/// Regressors: Legendre's polynomials of degree 0 … 3 in a logarithmic measure u of slip; q, ten times the deviation of
/// ln W from its mean; and u q.
pub const TERMS: usize = 6;
/// What is regressed: (T/r − DP)/W, T/(rW), and the contact angle θ₁ (rad; 0 where the sinkage is not known).
pub const CHANNELS: usize = 3;

/// Regressors and values of a wheel in one row.
pub type Row = [f32; TERMS + CHANNELS];

/// What is known of the coefficients before any wheel is seen: the inverse covariance of those of T/(rW), and its product
/// with the mean of each channel's; none for θ₁, which may be unknown. Least squares over slips 0.02 … 0.7 under Kapvik's
/// wheel, soil by soil of the training prior, with as many loads; each variance is a hundredth larger, which keeps the
/// inverse sound. A test of the host tools draws and fits anew.
pub static PRIOR: [Row; TERMS] = [
    [308.5, -53.39, 456.8, -1013.0, 437.5, 9634.0, 114.0, 62.56, 0.0],
    [-53.39, 2070.0, -4034.0, 24_900.0, 1582.0, -3951.0, 57.84, 122.2, 0.0],
    [456.8, -4034.0, 25_390.0, -59_480.0, -27_890.0, -29_210.0, -212.9, 51.72, 0.0],
    [-1013.0, 24_900.0, -59_480.0, 435_800.0, 63_770.0, -97_650.0, 1313.0, 1228.0, 0.0],
    [437.5, 1582.0, -27_890.0, 63_770.0, 187_600.0, 95_210.0, 2288.0, 898.1, 0.0],
    [9634.0, -3951.0, -29_210.0, -97_650.0, 95_210.0, 554_600.0, 4170.0, 1096.0, 0.0],
];
/// What the regressors leave of T/(rW) without any noise: one standard deviation.
const MISFIT: f32 = 5e-4;
/// Variance of T/(rW) by noise of the load: that of W/W̄ times the mean square of T/(rW) over the prior.
const BY_LOAD: f32 = 0.12;
/// Variance of T/(rW) by noise of the slip: that of the slip times the square of the mean slope against
/// ln(slip + [`OFFSET`]), 0.12, over the square of that sum.
const BY_SLIP: f32 = 0.015;
/// Added to slip where its logarithm is taken: of the values tried, 0.08 leaves the least misfit.
pub const OFFSET: f32 = 0.08;

/// One standard deviation of what the wheels show, as the features have it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrendNoise {
    /// Of W/W̄.
    pub load: f32,
    /// Of T/(rW̄).
    pub torque: f32,
    /// Of the slip.
    pub slip: f32,
}

/// How the wheels' states go with slip and load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trend {
    /// Of each term and channel.
    pub coefficients: [[f32; CHANNELS]; TERMS],
    /// Logarithm of how much better the coefficient of q is told than the constant, which says how far the loads are
    /// spread; mean of ln W.
    pub loads: [f32; 2],
}

/// Fits the trend over wheels.
pub fn trend(wheels: &[WheelFeatures], noise: TrendNoise) -> Trend {
    let ln_loads = wheels.iter().map(|[.., ln_load]| ln_load);
    let mean_ln_load = ln_loads.sum::<f32>() / wheels.len() as f32;
    let TrendNoise { load, torque, slip } = noise;
    let level = torque * torque + BY_LOAD * load * load + MISFIT * MISFIT;
    let by_slip = BY_SLIP * slip * slip;
    let mut rows = Vec::<(Row, f32), WHEELS>::new();
    for wheel in wheels.iter().take(WHEELS) {
        let (row, shifted) = row(wheel, mean_ln_load);
        // One over the variance of this wheel's T/(rW).
        let information = shifted * shifted / (level * shifted * shifted + by_slip);
        // Not `collect`: heapless panics where it overflows.
        let _ = rows.push((row, information));
    }
    let mut equations = [[0.0; TERMS + CHANNELS]; TERMS];
    normal_equations(&mut equations, &rows);
    let [[constant, ..], _, _, _, [_, _, _, _, load, ..], _] = equations;
    let loads = [0.5 * math::ln(load / constant), mean_ln_load];
    Trend { coefficients: solve(&mut equations), loads }
}

/// Regressors and values of a wheel, and the slip behind their logarithm.
fn row(wheel: &WheelFeatures, mean_ln_load: f32) -> (Row, f32) {
    let [pull, torque, slip, sinkage, ln_load] = *wheel;
    // Torque rises steeply at small slip and levels off: nearly even in the logarithm. Slips of 0.02 … 0.7 become −1 … 1.
    let shifted = math::limit(slip, 0.01, 1.0) + OFFSET;
    let u = (math::ln(shifted) + 1.275_523) * 0.973_651;
    let square = u * u;
    let q = 10.0 * (ln_load - mean_ln_load);
    // A sinkage of zero is one that nobody measured.
    let angle = if sinkage == 0.0 { 0.0 } else { math::acos(1.0 - math::limit(sinkage, 0.005, 0.9)) };
    ([1.0, u, 1.5 * square - 0.5, u * (2.5 * square - 1.5), q, u * q, torque - pull, torque, angle], shifted)
}

/// Fills in the prior, and upon it the sums over the wheels of products of regressors with regressors and values, a row a
/// regressor.
fn normal_equations(equations: &mut [Row; TERMS], rows: &[(Row, f32)]) {
    for ((term, place), prior) in equations.iter_mut().enumerate().zip(&PRIOR) {
        let mut sums = *prior;
        for (row, information) in rows {
            let share = information * row.get(term).copied().unwrap_or(0.0);
            sums.iter_mut().zip(row).for_each(|(sum, value)| *sum += share * value);
        }
        *place = sums;
    }
}

/// Gauss's elimination. The prior keeps every pivot above zero, so that none has to be looked for.
fn solve(equations: &mut [Row; TERMS]) -> [[f32; CHANNELS]; TERMS] {
    eliminate::<0>(equations);
    eliminate::<1>(equations);
    eliminate::<2>(equations);
    eliminate::<3>(equations);
    eliminate::<4>(equations);
    let mut coefficients = [[0.0; CHANNELS]; TERMS];
    substitute::<5>(equations, &mut coefficients);
    substitute::<4>(equations, &mut coefficients);
    substitute::<3>(equations, &mut coefficients);
    substitute::<2>(equations, &mut coefficients);
    substitute::<1>(equations, &mut coefficients);
    substitute::<0>(equations, &mut coefficients);
    coefficients
}

/// Frees the rows below row `PIVOT` of its unknown; columns up to its own are of no account any more. A constant, because
/// loops of fixed length cost the target half as much.
#[inline(always)]
fn eliminate<const PIVOT: usize>(equations: &mut [Row; TERMS]) {
    let (above, below) = equations.split_at_mut(PIVOT + 1);
    let Some(chosen) = above.last() else { return };
    let inverse = 1.0 / chosen.get(PIVOT).copied().unwrap_or(1.0);
    let chosen = chosen.split_at(PIVOT + 1).1;
    for row in below {
        let factor = inverse * row.get(PIVOT).copied().unwrap_or(0.0);
        row.split_at_mut(PIVOT + 1).1.iter_mut().zip(chosen).for_each(|(x, p)| *x -= factor * p);
    }
}

/// The unknown of row `PIVOT` from those behind it.
#[inline(always)]
fn substitute<const PIVOT: usize>(equations: &[Row; TERMS], coefficients: &mut [[f32; CHANNELS]; TERMS]) {
    let (before, behind) = coefficients.split_at_mut(PIVOT + 1);
    let (Some(row), Some(coefficient)) = (equations.get(PIVOT), before.last_mut()) else { return };
    let [regressors @ .., resistance, torque, angle] = row;
    let mut values = [*resistance, *torque, *angle];
    for (regressor, term) in regressors.split_at(PIVOT + 1).1.iter().zip(behind) {
        values.iter_mut().zip(term).for_each(|(value, coefficient)| *value -= regressor * *coefficient);
    }
    let inverse = 1.0 / regressors.get(PIVOT).copied().unwrap_or(1.0);
    *coefficient = values.map(|value| value * inverse);
}

#[cfg(test)]
mod tests {
    use super::{OFFSET, TERMS, Trend, TrendNoise, WheelFeatures, trend};
    use crate::network::{TREND_FEATURES, joined};

    /// Mean coefficients of T/(rW) over the training prior: least squares, soil by soil, by NumPy in f64.
    const MEAN: [f32; TERMS] = [0.320_485, 0.124_602, 0.009_646, -0.004_412, 0.008_139, -0.004_370];

    /// Six wheels whose T/(rW) is a known combination of the regressors; Legendre's polynomials written out anew.
    fn wheels(coefficients: [f32; TERMS]) -> Vec<WheelFeatures> {
        let ln_loads = [0.20_f32, 0.05, -0.15, 0.10, -0.25, 0.05]; // their mean is 0
        let slips = [0.02_f32, 0.10, 0.20, 0.35, 0.50, 0.70];
        let (least, most) = ((0.02 + OFFSET).ln(), (0.70 + OFFSET).ln());
        let wheel = |(slip, ln_load): (f32, f32)| {
            let u = (2.0 * (slip + OFFSET).ln() - least - most) / (most - least);
            let q = 10.0 * ln_load;
            let terms = [1.0, u, (3.0 * u * u - 1.0) / 2.0, (5.0 * u * u * u - 3.0 * u) / 2.0, q, u * q];
            let torque = terms.iter().zip(coefficients).map(|(term, coefficient)| term * coefficient).sum();
            [0.1, torque, slip, 0.0, ln_load]
        };
        slips.into_iter().zip(ln_loads).map(wheel).collect()
    }

    fn noise(share: f32) -> TrendNoise {
        TrendNoise { load: 0.015 * share, torque: 0.01 * share, slip: 0.01 * share }
    }

    /// Of T/(rW), term by term.
    fn torque_coefficients(trend: &Trend) -> [f32; TERMS] {
        trend.coefficients.map(|[_, torque, _]| torque)
    }

    #[test]
    fn finds_the_coefficients_that_made_the_torque() {
        let truth = [0.4, 0.10, -0.008, -0.006, 0.010, -0.007];
        let found = torque_coefficients(&trend(&wheels(truth), noise(1e-3)));
        for (found, truth) in found.into_iter().zip(truth) {
            assert!((found - truth).abs() < 5e-4, "{found}, truth {truth}");
        }
    }

    #[test]
    fn wheels_that_tell_nothing_leave_the_mean_of_the_prior() {
        let found = torque_coefficients(&trend(&wheels([0.0; TERMS]), noise(1e6)));
        for (found, mean) in found.into_iter().zip(MEAN) {
            assert!((found - mean).abs() < 1e-3 * MEAN[0], "{found}, mean {mean}");
        }
    }

    #[test]
    fn the_order_of_the_wheels_does_not_matter_and_one_wheel_is_enough() {
        let mut wheels = wheels([0.4, 0.10, -0.008, -0.006, 0.010, -0.007]);
        let first = trend(&wheels, noise(0.1));
        wheels.reverse();
        let numbers = |trend: &Trend| joined::<TREND_FEATURES, 2>([trend.coefficients.as_flattened(), &trend.loads]);
        for (there, back) in numbers(&first).into_iter().zip(numbers(&trend(&wheels, noise(0.1)))) {
            assert!((there - back).abs() < 1e-4 * (1.0 + there.abs()), "{there}, {back}");
        }
        assert!(numbers(&trend(&wheels[..1], noise(0.1))).iter().all(|value| value.is_finite()));
    }
}
