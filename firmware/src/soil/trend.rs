//! How resistance, torque and contact angle go with slip and load over the wheels of an instant.
//!
//! Cohesion differs from friction in how little of the shear strength goes with the load, and K shows in how the torque
//! goes with slip. Both are differences among wheels, small beside what the wheels have in common, and a network learns
//! them slowly from the wheels one by one. A ridge regression over the wheels says them outright.

use heapless::Vec;

use crate::math;
use crate::network::{TREND_FEATURES, joined};
use crate::wheel_state::WHEELS;

use super::WheelFeatures;

/// Regressors: Legendre's polynomials of degree 0 … 3 in a logarithmic measure of slip, and q, ten times the deviation of
/// ln W from its mean.
const TERMS: usize = 5;
/// How far the coefficients of T/(rW) are spread over the soils of the training prior; of the constant, which is told best,
/// three times as far. Seen where the network was trained, without noise; two digits are enough.
const SPREAD: [f32; TERMS] = [0.3, 0.06, 0.035, 0.015, 0.004];
/// What the regressors leave of T/(rW) without any noise: one standard deviation.
const MISFIT: f32 = 5e-4;
/// What is regressed: (T/r − DP)/W, T/(rW), and the contact angle θ₁ (rad; 0 where the sinkage is not known).
const CHANNELS: usize = 3;

/// The coefficients, term by term; the logarithm of each channel's residual; that of the spread of the loads, and their
/// mean.
pub type Trend = [f32; TREND_FEATURES];

/// Regressors and values of a wheel in one row.
type Row = [f32; TERMS + CHANNELS];

/// Fits the trend over wheels whose T/(rW) has the standard deviation `torque_noise`.
pub fn trend(wheels: &[WheelFeatures], torque_noise: f32) -> Trend {
    let ln_loads = wheels.iter().map(|[.., ln_load]| ln_load);
    let mean_ln_load = ln_loads.sum::<f32>() / wheels.len() as f32;
    let mut rows = Vec::<Row, WHEELS>::new();
    for wheel in wheels.iter().take(WHEELS) {
        // Not `collect`: heapless panics where it overflows.
        let _ = rows.push(row(wheel, mean_ln_load));
    }
    let (equations, load_spread) = normal_equations(&rows, torque_noise);
    let coefficients = solve(equations);
    let mut squares = [LEAST_SQUARE; CHANNELS];
    rows.iter().for_each(|row| add_residuals(&mut squares, &coefficients, row));
    let [resistance, torque, angle] = squares.map(half_ln);
    joined([coefficients.as_flattened(), &[resistance, torque, angle, half_ln(load_spread), mean_ln_load]])
}

/// Logarithm of the root.
fn half_ln(square: f32) -> f32 {
    0.5 * math::ln(square)
}

/// Keeps the logarithm of a sum of squared residuals finite.
const LEAST_SQUARE: f32 = 1e-10;

fn row(wheel: &WheelFeatures, mean_ln_load: f32) -> Row {
    let [pull, torque, slip, sinkage, ln_load] = *wheel;
    // Torque rises steeply at small slip and levels off: nearly even in the logarithm. Slips of 0.02 … 0.7 become −1 … 1.
    let u = (math::ln(math::limit(slip, 0.01, 1.0) + 0.05) + 1.48) * (1.0 / 1.19);
    let square = u * u;
    let q = 10.0 * (ln_load - mean_ln_load);
    // A sinkage of zero is one that nobody measured.
    let angle = if sinkage == 0.0 { 0.0 } else { math::acos(1.0 - math::limit(sinkage, 0.005, 0.9)) };
    [1.0, u, 1.5 * square - 0.5, u * (2.5 * square - 1.5), q, torque - pull, torque, angle]
}

/// Sums of products of the regressors with regressors and values, a row a regressor, the ridge on the diagonal; and the
/// mean square of q with its ridge.
fn normal_equations(rows: &[Row], torque_noise: f32) -> ([Row; TERMS], f32) {
    let mut equations = [[0.0_f32; TERMS + CHANNELS]; TERMS];
    for (term, sums) in equations.iter_mut().enumerate() {
        for row in rows {
            let share = SIXTH * row.get(term).copied().unwrap_or(0.0);
            sums.iter_mut().zip(row).for_each(|(sum, value)| *sum += share * value);
        }
    }
    let variance = SIXTH * (torque_noise * torque_noise + MISFIT * MISFIT);
    let mut load_spread = 1.0;
    for (term, (sums, spread)) in equations.iter_mut().zip(SPREAD).enumerate() {
        if let Some(diagonal) = sums.get_mut(term) {
            *diagonal += variance / (spread * spread);
            load_spread = *diagonal;
        }
    }
    (equations, load_spread)
}

/// One wheel's share of the sums.
const SIXTH: f32 = 1.0 / 6.0;

/// Gauss–Jordan elimination. The ridge keeps every pivot above zero, so that none has to be looked for.
fn solve(mut equations: [Row; TERMS]) -> [[f32; CHANNELS]; TERMS] {
    for pivot in 0..TERMS {
        let Some(mut chosen) = equations.get(pivot).copied() else { continue };
        let scale = 1.0 / chosen.get(pivot).copied().unwrap_or(1.0);
        chosen.iter_mut().for_each(|x| *x *= scale);
        for (index, row) in equations.iter_mut().enumerate() {
            if index == pivot {
                *row = chosen;
            } else {
                let factor = row.get(pivot).copied().unwrap_or(0.0);
                row.iter_mut().zip(&chosen).for_each(|(x, p)| *x -= factor * p);
            }
        }
    }
    equations.map(|[.., resistance, torque, angle]| [resistance, torque, angle])
}

fn add_residuals(squares: &mut [f32; CHANNELS], coefficients: &[[f32; CHANNELS]; TERMS], row: &Row) {
    let [regressors @ .., resistance, torque, angle] = row;
    let mut residuals = [*resistance, *torque, *angle];
    for (regressor, term) in regressors.iter().zip(coefficients) {
        residuals.iter_mut().zip(term).for_each(|(residual, coefficient)| *residual -= regressor * coefficient);
    }
    squares.iter_mut().zip(residuals).for_each(|(square, residual)| *square += residual * residual);
}

#[cfg(test)]
mod tests {
    use super::{TERMS, Trend, WheelFeatures, trend};

    /// Six wheels whose T/(rW) is a known combination of the regressors; Legendre's polynomials written out anew.
    fn wheels(coefficients: [f32; TERMS]) -> Vec<WheelFeatures> {
        let ln_loads = [0.20_f32, 0.05, -0.15, 0.10, -0.25, 0.05]; // their mean is 0
        let slips = [0.02_f32, 0.10, 0.20, 0.35, 0.50, 0.70];
        let wheel = |(slip, ln_load): (f32, f32)| {
            let u = ((slip + 0.05).ln() + 1.48) / 1.19;
            let terms = [1.0, u, (3.0 * u * u - 1.0) / 2.0, (5.0 * u * u * u - 3.0 * u) / 2.0, 10.0 * ln_load];
            let torque = terms.iter().zip(coefficients).map(|(term, coefficient)| term * coefficient).sum();
            [0.1, torque, slip, 0.0, ln_load]
        };
        slips.into_iter().zip(ln_loads).map(wheel).collect()
    }

    /// Of T/(rW), term by term.
    fn torque_coefficients(trend: &Trend) -> [f32; TERMS] {
        std::array::from_fn(|term| trend[3 * term + 1])
    }

    #[test]
    fn finds_the_coefficients_that_made_the_torque() {
        let truth = [0.4, 0.06, -0.03, 0.012, 0.004];
        let found = torque_coefficients(&trend(&wheels(truth), 1e-5));
        for (found, truth) in found.into_iter().zip(truth) {
            assert!((found - truth).abs() < 0.05 * truth.abs(), "{found}, truth {truth}");
        }
    }

    #[test]
    fn noise_takes_the_slow_terms_last() {
        let truth = [0.4, 0.06, -0.03, 0.012, 0.004];
        let [mean, .., cubic, load] = torque_coefficients(&trend(&wheels(truth), 0.1));
        assert!((mean - 0.4).abs() < 0.04, "{mean}");
        assert!(cubic.abs() < 0.2 * 0.012 && load.abs() < 0.2 * 0.004, "{cubic}, {load}");
    }

    #[test]
    fn the_order_of_the_wheels_does_not_matter_and_one_wheel_is_enough() {
        let mut wheels = wheels([0.4, 0.06, -0.03, 0.012, 0.004]);
        let first = trend(&wheels, 1e-3);
        wheels.reverse();
        for (there, back) in first.iter().zip(trend(&wheels, 1e-3)) {
            assert!((there - back).abs() < 1e-4 * (1.0 + there.abs()), "{there}, {back}");
        }
        assert!(trend(&wheels[..1], 1e-3).iter().all(|value| value.is_finite()));
    }
}
