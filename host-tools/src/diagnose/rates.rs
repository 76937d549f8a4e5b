//! How fast wheels turned.
//!
//! Speed, rate and slip of a wheel are one statement: v = r ω (1 − i). Whoever holds a measured speed beside a measured slip for
//! a circumstance of the run, gives every row a second reading of its slip, which has no part in the noise of the first; and
//! whatever follows speed then seems to explain what only the noise of the slip did. So of the three, slip is what was measured
//! and has an error, the rate is what was set, and the speed follows from both.

use kapvik_firmware::terramechanics::effects::speed_ratio;

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
        let (ratio, by_slip) = (speed_ratio(slip), speed_ratio_by_slip(slip));
        let rate_rad_s = speed_m_s / (radius_m * ratio);
        let std = row.noise[Reading::Slip.index()] * (by_slip / ratio).abs();
        // In the logarithm, for the noise of the slip is a share of the rate.
        (rate_rad_s.is_finite() && rate_rad_s > 0.0).then(|| (rate_rad_s.ln(), std))
    };
    let mut values: Vec<Option<(f64, f64)>> = places.iter().zip(rows).map(of_row).collect();
    settle_values(&mut values, rows_of_run);
    values.into_iter().map(|value| value.map(|(ln_rate, _)| ln_rate.exp())).collect()
}

/// The derivative of v / (r ω) by the slip.
pub fn speed_ratio_by_slip(slip: f64) -> f64 {
    if slip < 0.0 { -speed_ratio(slip).powi(2) } else { -1.0 }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;
    use std::path::Path;

    use super::*;
    use crate::diagnose::fit::CHANNELS;

    const NOISE: f64 = 0.01;

    /// One row a run at slips of 0.05 to 0.6, read alternately too high and too low by the noise; rates in turn.
    fn rates(true_rates: &[f64]) -> Vec<f64> {
        let toml = "name = \"Rates\"\nkind = \"simulated\"\nsource = \"v = r w (1 - i)\"\n[wheel]\nradius_m = 0.1\nwidth_m = 0.1\n";
        let mut csv = "run,t_s,slip,load_n,drawbar_pull_n,speed_m_s\n".to_owned();
        let mut rows = Vec::new();
        for run in 0..24 {
            let slip = 0.05 + 0.55 * run as f64 / 23.0;
            let read = slip + if run % 4 < 2 { NOISE } else { -NOISE };
            let speed_m_s = 0.1 * true_rates[run % true_rates.len()] * (1.0 - slip);
            writeln!(csv, "{run},0,{read},50,5,{speed_m_s}").expect("a string takes it");
            let mut row = Row { run, readings: [None; CHANNELS], noise: [NOISE; CHANNELS] };
            row.readings[Reading::Slip.index()] = Some(read);
            rows.push(row);
        }
        let campaign = Campaign::parse(Path::new("rates.csv"), &csv, toml).expect("a campaign");
        let (places, runs): (Vec<usize>, Vec<Vec<usize>>) = (0..24).map(|row| (row, vec![row])).unzip();
        wheel_rates(&campaign, &places, &rows, &runs).into_iter().map(|rate| rate.expect("a rate")).collect()
    }

    /// Readings of the slip that are off by up to 2.5 % of the speed leave the one rate that there is within 0.5 %.
    #[test]
    fn one_rate_is_found_through_noisy_slips() {
        for rate in rates(&[0.3]) {
            assert!((rate / 0.3 - 1.0).abs() < 5e-3, "{rate}");
        }
    }

    #[test]
    fn two_rates_stay_two() {
        for (run, rate) in rates(&[0.3, 0.9]).into_iter().enumerate() {
            assert!((rate / [0.3, 0.9][run % 2] - 1.0).abs() < 1e-2, "{rate}");
        }
    }
}
