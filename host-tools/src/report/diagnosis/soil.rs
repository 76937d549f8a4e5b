//! The soil parameters before and after, beside what was known.

use maud::{Markup, html};

use super::bars::interval;
use super::figures::{bound, with_std};
use super::findings::DiagnosisFindings;
use super::pair::span;
use super::quantity::{Quantity, SOIL_KEYS};
use crate::data::campaign::Knowledge;
use crate::diagnose::document::Estimate;
use crate::report::draw::{Scale, px, vertical_band};

const WIDTH: f64 = 260.0;
const HEIGHT: f64 = 34.0;

/// One parameter.
struct Row {
    quantity: Quantity,
    known: Option<Knowledge>,
    before: Option<Estimate>,
    after: Option<Estimate>,
}

/// The table; nothing where no parameter was fitted.
pub fn table(findings: &DiagnosisFindings) -> Markup {
    let diagnosis = &findings.diagnosis;
    let fitted = |key: &&str| diagnosis.soil_before.contains_key(*key) || diagnosis.soil_after.contains_key(*key);
    let row = |key: &str| Row {
        quantity: Quantity::of_soil(key),
        known: findings.known.get(key).copied(),
        before: diagnosis.soil_before.get(key).copied(),
        after: diagnosis.soil_after.get(key).copied(),
    };
    let rows: Vec<Row> = SOIL_KEYS.into_iter().filter(fitted).map(row).collect();
    if rows.is_empty() {
        return html! { p { "No parameter of the soil was fitted." } };
    }
    html! {
        div class="scroll" {
            table class="numbers soil" {
                thead { tr { th { "Parameter" } th { "Known before" } th { "Before" } th { "After" } th {} } }
                tbody { @for row in &rows { (line(row)) } }
            }
        }
    }
}

fn line(row: &Row) -> Markup {
    let factor = row.quantity.factor;
    let shown = |estimate: Option<Estimate>| estimate.map_or_else(|| "–".to_owned(), |known| with_std(known, factor));
    html! {
        tr {
            td { (row.quantity.titled()) }
            td { (row.known.map_or_else(|| "–".to_owned(), |known| knowledge(known, factor))) }
            td class="before" { (shown(row.before)) }
            td class="after" { (shown(row.after)) }
            td { (picture(row)) }
        }
    }
}

/// What was known as a number with its deviation, or between bounds.
fn knowledge(known: Knowledge, factor: f64) -> String {
    match known {
        Knowledge::Value { value, std } => with_std(Estimate { value, std }, factor),
        Knowledge::Between { min, max } => {
            format!("{} to {}", bound(factor * min), bound(factor * max))
        }
    }
}

/// Before above after, each over two standard deviations, on what was known.
fn picture(row: &Row) -> Markup {
    let band = row.known.map(|known| known.within(2.0));
    let ends = |estimate: Estimate| [estimate.value - 2.0 * estimate.std, estimate.value + 2.0 * estimate.std];
    let all = [row.before, row.after].into_iter().flatten().flat_map(ends);
    let Some((low, high)) = span(all.chain(band.into_iter().flat_map(|(low, high)| [low, high]))) else {
        return html! {};
    };
    let scale = Scale::linear(low, high, (4.0, WIDTH - 4.0));
    html! {
        svg class="interval" width=(px(WIDTH)) height=(px(HEIGHT)) viewBox={ "0 0 " (px(WIDTH)) " " (px(HEIGHT)) }
            role="img" aria-label={ (row.quantity.name) " before and after" } {
            @if let Some((low, high)) = band {
                (vertical_band("known", (scale.at(low), scale.at(high)), (1.0, HEIGHT - 1.0)))
            }
            @for (estimate, class, y) in [(row.before, "before", 11.0), (row.after, "after", 23.0)] {
                @if let Some(estimate) = estimate { (interval(class, &scale, (estimate.value, estimate.std), y)) }
            }
        }
    }
}
