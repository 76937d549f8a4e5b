//! The tables of before and after.

use std::collections::BTreeMap;

use comfy_table::Table;
use kapvik_firmware::terramechanics::Soil;

use crate::diagnose::document::{Diagnosis, Estimate};
use crate::parameter::Parameter;
use crate::report::diagnosis::Quantity;
use crate::terminal_table::{align_right, plain_table};
use crate::train::score::Score;

use super::on_campaign::{CampaignSoil, SoilColumn};

/// What stands for a number that there is not.
const NOTHING_THERE: &str = "–";

/// Errors of forces and sinkage on runs that took no part in fitting or choosing.
pub fn errors_of_forces(diagnosis: &Diagnosis) -> String {
    let mut table = table(&["channel", "before", "after", "noise", "runs"]);
    for (channel, errors) in &diagnosis.channels {
        let shown = Quantity::of_column(channel);
        let number = |value: f64| format!("{:.3}", shown.factor * value);
        let error = |value: Option<f64>| value.map_or_else(|| NOTHING_THERE.to_owned(), number);
        table.add_row([
            shown.titled(),
            error(errors.rmse_before),
            error(errors.rmse_after),
            number(errors.noise_of_error()),
            errors.runs.to_string(),
        ]);
    }
    aligned(table)
}

/// Errors of c, φ and K of the networks before and after, on simulated rovers on soil with the effect.
pub fn errors_of_soil(kinds: &[(&'static str, Vec<Score>)]) -> String {
    let mut table = table(&[
        "rovers",
        "network",
        "φ RMSE/°",
        "φ bias/°",
        "K median/%",
        "ln K RMSE",
        "ln c RMSE",
        "within 1σ c φ K/%",
        "within 1.96σ c φ K/%",
    ]);
    for (kind, scores) in kinds {
        for (name, score) in ["before", "after"].into_iter().zip(scores) {
            let [c, phi, k] = score;
            let within = |place: usize| {
                let shares = score.iter().map(|target| format!("{:.0}", 100.0 * target.std_coverage[place]));
                shares.collect::<Vec<_>>().join(" ")
            };
            table.add_row([
                (*kind).to_owned(),
                name.to_owned(),
                format!("{:.2}", phi.rmse.to_degrees()),
                format!("{:+.2}", phi.bias.to_degrees()),
                format!("{:.1}", 100.0 * k.median_ratio_error),
                format!("{:.3}", k.rmse),
                format!("{:.3}", c.rmse),
                within(0),
                within(1),
            ]);
        }
    }
    aligned(table)
}

/// c, φ and K of the campaign's own soil by both networks and by both fits of the diagnosis (keys as in `[soil]`), and how
/// wrong they are where the truth is known.
pub fn estimates(
    networks: &[CampaignSoil],
    fits: [&BTreeMap<String, Estimate>; 2],
    truth: Option<&Soil<f64>>,
) -> String {
    let mut header = vec!["parameter", "by", "estimate", "68 % interval"];
    header.extend(truth.map_or(vec![], |_| vec!["truth", "error", "error/σ"]));
    header.extend(["scatter of runs", "runs", "outside"]);
    let mut table = table(&header);
    for (place, of) in Parameter::ALL.into_iter().enumerate() {
        let truth = truth.map(|soil| of.of_soil(soil));
        for (name, soil) in
            ["network before", "network after"].into_iter().zip(networks).filter(|(_, soil)| soil.runs > 0)
        {
            let SoilColumn { value, interval_68, scatter } = soil.parameters[place];
            let mut row = row(of, name, value, interval_68, truth);
            row.extend([number(of, scatter), soil.runs.to_string(), soil.outside.to_string()]);
            table.add_row(row);
        }
        for (name, fit) in ["fit before", "fit after"].into_iter().zip(fits) {
            // What the campaign's file fixes was not fitted.
            if let Some(Estimate { value, std }) = fit.get(of.key()) {
                let mut row = row(of, name, *value, [value - std, value + std], truth);
                row.extend([NOTHING_THERE, NOTHING_THERE, NOTHING_THERE].map(str::to_owned));
                table.add_row(row);
            }
        }
    }
    let refused = networks.iter().find_map(|soil| soil.refused.as_ref());
    let of_networks = match refused {
        Some(why) => format!("no estimate by the networks: {why}"),
        None => "network: medians over the runs; outside: runs unlike anything that it was trained with".to_owned(),
    };
    let of_fits = "fit: the diagnosis' own, of all runs at once, with the priors of the campaign's file";
    format!("{}\n\n{of_networks}\n{of_fits}", aligned(table))
}

/// Name, who says so, the estimate with its interval and, where the truth is known, truth and error.
fn row(of: Parameter, by: &str, value: f64, [low, high]: [f64; 2], truth: Option<f64>) -> Vec<String> {
    // None of them is negative, whatever the standard deviation says.
    let interval = format!("{} … {}", number(of, low.max(0.0)), number(of, high));
    let mut row = vec![of.titled(), by.to_owned(), number(of, value), interval];
    if let Some(truth) = truth {
        let error = value - truth;
        let deviations = 2.0 * error / (high - low);
        let signed = |text: String, number: f64| if number > 0.0 { format!("+{text}") } else { text };
        row.push(number(of, truth));
        row.push(signed(number(of, error), error));
        row.push(match deviations.is_finite() {
            true => signed(format!("{deviations:.1}"), deviations),
            false => NOTHING_THERE.to_owned(),
        });
    }
    row
}

fn number(of: Parameter, value: f64) -> String {
    match value.is_finite() {
        true => format!("{:.*}", of.decimals(), of.shown(value)),
        false => NOTHING_THERE.to_owned(),
    }
}

fn table(header: &[&str]) -> Table {
    let mut table = plain_table();
    table.set_header(header.iter().copied());
    table
}

/// Words to the left, numbers to the right.
fn aligned(mut table: Table) -> String {
    align_right(&mut table);
    table.trim_fmt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn soil(friction_angle_deg: f64) -> Soil<f64> {
        Soil {
            sinkage_exponent: 1.0,
            cohesive_modulus: 0.0,
            frictional_modulus: 1e6,
            cohesion_pa: 500.0,
            friction_angle_rad: friction_angle_deg.to_radians(),
            shear_modulus_m: 0.015,
            peak_stress_c1: 0.4,
            peak_stress_c2: 0.2,
            rebound_ratio: 0.0,
        }
    }

    fn network(friction_angle_deg: f64) -> CampaignSoil {
        let column = |value: f64, std: f64| SoilColumn { value, interval_68: [value - std, value + std], scatter: std };
        let phi = column(friction_angle_deg.to_radians(), 2_f64.to_radians());
        CampaignSoil { runs: 3, refused: None, outside: 0, parameters: [column(400.0, 100.0), phi, column(0.02, 0.01)] }
    }

    fn cells<'a>(text: &'a str, by: &str, parameter: &str) -> Vec<&'a str> {
        let line = text.lines().find(|line| line.contains(by) && line.trim_start().starts_with(parameter));
        line.expect("a row").split_whitespace().collect()
    }

    /// 36° ± 2° of 30° is 6° too much, three standard deviations; 31° is 1°, half a one.
    #[test]
    fn where_the_truth_is_known_the_error_is_shown() {
        let fit = BTreeMap::from([("phi".to_owned(), Estimate { value: 0.5, std: 0.1 })]);
        let text = estimates(&[network(36.0), network(31.0)], [&fit, &BTreeMap::new()], Some(&soil(30.0)));
        let words = cells(&text, "network before", "φ");
        assert!(words.windows(3).any(|words| words == ["30.0", "+6.0", "+3.0"]), "{text}");
        assert!(cells(&text, "network after", "φ").windows(3).any(|words| words == ["30.0", "+1.0", "+0.5"]), "{text}");
        assert!(cells(&text, "network after", "c").contains(&"-100"), "{text}");
        assert!(cells(&text, "fit before", "φ").contains(&"28.6") && !text.contains("fit after"), "{text}");
    }

    #[test]
    fn where_the_networks_say_nothing_it_says_why() {
        let silent = CampaignSoil { runs: 0, refused: Some("torque_nm is missing".to_owned()), ..network(30.0) };
        let fit = BTreeMap::from([("phi".to_owned(), Estimate { value: 0.5, std: 0.1 })]);
        let text = estimates(&[silent.clone(), silent], [&fit, &fit], None);
        assert!(text.contains("torque_nm is missing") && text.contains("fit after"), "{text}");
        assert!(!text.contains("network before"), "{text}");
    }

    #[test]
    fn where_it_is_not_there_is_only_the_interval() {
        let nothing = BTreeMap::new();
        let text = estimates(&[network(36.0), network(31.0)], [&nothing, &nothing], None);
        assert!(text.contains("34.0 … 38.0") && !text.contains("truth") && !text.contains("error"), "{text}");
    }
}
