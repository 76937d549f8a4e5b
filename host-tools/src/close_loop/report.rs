//! The tables of before and after.

use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, Table};

use crate::diagnose::document::Diagnosis;
use crate::train::score::Score;

use super::on_campaign::{CampaignSoil, SoilColumn};

/// What stands for a number that there is not.
const NOTHING_THERE: &str = "–";

/// Errors of forces and sinkage on runs that took no part in fitting or choosing.
pub fn errors_of_forces(diagnosis: &Diagnosis) -> String {
    let mut table = table(&["channel", "before", "after", "noise", "runs"]);
    for (channel, errors) in &diagnosis.channels {
        let (scale, unit) = unit(channel);
        let number = |value: f64| format!("{:.3}", scale * value);
        table.add_row([
            format!("{channel} / {unit}"),
            number(errors.rmse_before),
            number(errors.rmse_after),
            number(errors.noise),
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

/// Estimates and intervals on the campaign's own soil, before and after.
pub fn intervals(soils: &[CampaignSoil]) -> String {
    let mut table = table(&["parameter", "network", "median", "68 % interval", "scatter of runs", "runs", "outside"]);
    let parameters = [("c / Pa", 1.0, 0), ("φ / °", 180.0 / std::f64::consts::PI, 1), ("K / mm", 1e3, 1)];
    for (place, (parameter, scale, digits)) in parameters.into_iter().enumerate() {
        for (name, soil) in ["before", "after"].into_iter().zip(soils) {
            let SoilColumn { value, interval_68: [low, high], scatter } = soil.parameters[place];
            let number = |value: f64| match value.is_finite() {
                true => format!("{:.digits$}", scale * value),
                false => NOTHING_THERE.to_owned(),
            };
            table.add_row([
                parameter.to_owned(),
                name.to_owned(),
                number(value),
                format!("{} … {}", number(low), number(high)),
                number(scatter),
                soil.runs.to_string(),
                soil.outside.to_string(),
            ]);
        }
    }
    aligned(table)
}

/// The factor and the unit in which a channel is shown.
fn unit(channel: &str) -> (f64, &'static str) {
    if channel.ends_with("_nm") {
        (1.0, "N·m")
    } else if channel.ends_with("_n") {
        (1.0, "N")
    } else if channel.ends_with("_m") {
        (1e3, "mm")
    } else {
        (1.0, "–")
    }
}

fn table(header: &[&str]) -> Table {
    let mut table = Table::new();
    table.load_style(NOTHING).set_header(header.iter().copied());
    table
}

/// Words to the left, numbers to the right.
fn aligned(mut table: Table) -> String {
    table.column_iter_mut().skip(1).for_each(|column| column.set_cell_alignment(CellAlignment::Right));
    table.trim_fmt()
}
