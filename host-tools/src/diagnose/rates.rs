//! How fast wheels turned.
//!
//! Speed, rate and slip of a wheel are one statement: v = r ω (1 − i). Whoever holds a measured speed beside a measured slip for
//! a circumstance of the run, gives every row a second reading of its slip, which has no part in the noise of the first; and
//! whatever follows speed then seems to explain what only the noise of the slip did. So of the three, slip is what was measured
//! and has an error, the rate is what was set, and the speed follows from both.

use crate::data::campaign::{Campaign, Channel};

use super::fit::{Reading, Row};
use super::settings::settle_values;

/// The wheel rate of each row, rad/s: as measured; else from its speed and slip, as a rig holds it at levels.
pub fn wheel_rates(
    campaign: &Campaign,
    places: &[usize],
    rows: &[Row],
    rows_of_run: &[Vec<usize>],
) -> Vec<Option<f64>> {
    let measured = |place: &usize| campaign.value(*place, Channel::WheelRate);
    let rates: Vec<Option<f64>> = places.iter().map(measured).collect();
    if rates.iter().any(Option::is_some) {
        return rates;
    }
    let radius_m = campaign.wheel.radius_m;
    let of_row = |(place, row): (&usize, &Row)| {
        let speed_m_s = campaign.value(*place, Channel::Speed)?;
        let slip = row.readings[Reading::Slip.index()]?;
        let (ratio, by_slip) = speed_ratio(slip);
        let rate_rad_s = speed_m_s / (radius_m * ratio);
        let std = row.noise[Reading::Slip.index()] * (by_slip / ratio).abs();
        // In the logarithm, for the noise of the slip is a share of the rate.
        (rate_rad_s.is_finite() && rate_rad_s > 0.0).then(|| (rate_rad_s.ln(), std))
    };
    let mut values: Vec<Option<(f64, f64)>> = places.iter().zip(rows).map(of_row).collect();
    settle_values(&mut values, rows_of_run);
    values.into_iter().map(|value| value.map(|(ln_rate, _)| ln_rate.exp())).collect()
}

/// v / (r ω) at a slip, and its derivative by the slip.
pub fn speed_ratio(slip: f64) -> (f64, f64) {
    if slip < 0.0 {
        let ratio = 1.0 / (1.0 + slip);
        (ratio, -ratio * ratio)
    } else {
        (1.0 - slip, -1.0)
    }
}
