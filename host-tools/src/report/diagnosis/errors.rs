//! How wrong the model was on runs that it did not know, before and after.

use maud::{Markup, html};

use super::figures::{beside_noise, bound, change};
use super::findings::DiagnosisFindings;
use super::quantity::Quantity;
use crate::diagnose::document::{ChannelErrors, Diagnosis, EndsApart, ErrorPair};
use crate::report::draw::{Anchor, Scale, bottom_axis, dot, line, page_chart, text, vertical_band};

const WIDTH: f64 = 900.0;
const LEFT: f64 = 150.0;
const RIGHT: f64 = WIDTH - 60.0;
const TOP: f64 = 12.0;
const ROW: f64 = 30.0;

/// The picture and the table.
pub fn section(findings: &DiagnosisFindings) -> Markup {
    html! {
        (picture(findings))
        (table(findings))
        @if let Some(ends) = &findings.diagnosis.ends_apart { (ends_table(&findings.diagnosis, ends)) }
    }
}

/// Every channel as a line from before to after, in units of its noise.
fn picture(findings: &DiagnosisFindings) -> Markup {
    let in_noise = |errors: &ChannelErrors| {
        let ErrorPair { rmse_before, rmse_after } = errors.pair()?;
        Some([rmse_before, rmse_after].map(|error| error / errors.noise_of_error()))
    };
    let channels = findings.diagnosis.channels.iter();
    let channels: Vec<_> = channels.filter_map(|(name, errors)| Some((name, in_noise(errors)?))).collect();
    let scale = Scale::around(channels.iter().flat_map(|(_, errors)| *errors).chain([1.2]), (LEFT, RIGHT));
    let bottom = TOP + ROW * channels.len() as f64;
    let height = bottom + 42.0;
    let content = html! {
        (vertical_band("expected", (scale.at(0.0), scale.at(1.0)), (TOP, bottom)))
        (bottom_axis(&scale, (TOP, bottom)))
        (text("tick", (scale.at(0.5), TOP - 2.0), Anchor::Middle, "noise"))
        @for ((name, errors), place) in channels.iter().zip(0_u32..) {
            @let y = TOP + ROW * (f64::from(place) + 0.5);
            @let [before, after] = errors.map(|error| scale.at(error));
            (text("label", (LEFT - 12.0, y + 4.0), Anchor::End, &Quantity::of_column(name).name))
            (line("step", (before, y), (after, y)))
            (dot("before", (before, y), 5.0))
            (dot("after", (after, y), 5.0))
        }
        (text("tick", (0.5 * (LEFT + RIGHT), height - 8.0), Anchor::Middle,
            "root mean square error on held-out runs, in standard deviations of the noise (before rust, after blue)"))
    };
    let words = "Root mean square error of every channel, before and after, in units of its noise";
    page_chart((WIDTH, height), words, &content)
}

fn table(findings: &DiagnosisFindings) -> Markup {
    let diagnosis = &findings.diagnosis;
    let levels = diagnosis.leave_level_out.as_ref();
    html! {
        div class="scroll" {
            table class="numbers" {
                caption { "Root mean square error on runs that the fits did not know; effects chosen without them among those that all runs leave in question" }
                thead {
                    tr {
                        th { "Channel" } th { "Noise" } th { "Before" } th { "After" } th { "Change" } th { "Runs" }
                        @if levels.is_some() { th { "Slip level left out: before" } th { "after" } }
                    }
                }
                tbody {
                    @for (name, errors) in &diagnosis.channels {
                        (row(name, errors, levels.map(|levels| levels.channels.get(name))))
                    }
                }
            }
        }
        @if diagnosis.channels.values().any(|errors| !errors.noise_stated) {
            p class="note" { "* estimated from the scatter of these data; the campaign states none." }
        }
        @if let Some(levels) = levels {
            p class="note" {
                "The two last columns: all runs of one slip (" (slips(&levels.slips)) ") left out together, so that the model "
                "is asked for a slip that it has not seen."
            }
        }
    }
}

fn row(name: &str, errors: &ChannelErrors, level: Option<Option<&ErrorPair>>) -> Markup {
    let quantity = Quantity::of_column(name);
    let noise = errors.noise_of_error();
    html! {
        tr {
            td { (quantity.titled()) }
            td { (beside_noise(quantity.factor * noise, quantity.factor * noise)) @if !errors.noise_stated { " *" } }
            (pair_cells(errors.pair().as_ref(), quantity.factor, noise))
            td { (errors.pair().map_or_else(|| "–".to_owned(), |pair| change(pair.rmse_before, pair.rmse_after))) }
            td { (errors.runs) }
            @if let Some(pair) = level { (pair_cells(pair, quantity.factor, noise)) }
        }
    }
}

/// The lowest and the highest slip apart from those between.
fn ends_table(diagnosis: &Diagnosis, ends: &EndsApart) -> Markup {
    html! {
        div class="scroll" {
            table class="numbers" {
                caption { "The same for the lowest and the highest slip apart" }
                thead { tr { th { "Channel" } th { "Before, ends" } th { "After, ends" } th { "Before, between" } th { "After, between" } } }
                tbody {
                    @for (name, errors) in &diagnosis.channels {
                        @if ends.ends.contains_key(name) || ends.between.contains_key(name) {
                            @let quantity = Quantity::of_column(name);
                            tr {
                                td { (quantity.titled()) }
                                @for pair in [ends.ends.get(name), ends.between.get(name)] {
                                    (pair_cells(pair, quantity.factor, errors.noise_of_error()))
                                }
                            }
                        }
                    }
                }
            }
        }
        p class="note" { "At the ends a held-out prediction extrapolates. Runs: " (ends.runs.join(", ")) "." }
    }
}

/// Two cells, in the shown unit; a dash where there is nothing.
fn pair_cells(pair: Option<&ErrorPair>, factor: f64, noise: f64) -> Markup {
    let shown = |value: f64| beside_noise(factor * value, factor * noise);
    html! {
        @match pair {
            Some(pair) => { td class="before" { (shown(pair.rmse_before)) } td class="after" { (shown(pair.rmse_after)) } }
            None => { td { "–" } td { "–" } }
        }
    }
}

fn slips(slips: &[f64]) -> String {
    slips.iter().map(|slip| bound(*slip)).collect::<Vec<_>>().join(", ")
}
