//! What was measured and what was predicted, against slip.

use maud::{Markup, html};

use super::findings::{DiagnosisFindings, Side};
use super::pair::{Pair, span, stride};
use super::quantity::Quantity;
use crate::data::campaign::Channel;
use crate::diagnose::{Trace, Traced};
use crate::report::draw::{Scale, dot, line};
use crate::report::legend::entry;

/// Half the width of a prediction's mark.
const HALF: f64 = 4.5;

/// The plots of all channels.
pub fn charts(findings: &DiagnosisFindings) -> Markup {
    let Some(slips) = findings.column(Channel::Slip.name()) else {
        return html! { p { "Nothing is drawn: there is no slip." } };
    };
    html! {
        @for trace in &findings.traces { (chart(findings, trace, &slips)) }
        (legend())
    }
}

fn chart(findings: &DiagnosisFindings, trace: &Trace, slips: &[Option<f64>]) -> Markup {
    let quantity = Quantity::of_column(&trace.channel);
    let used = trace.rows.iter().zip(slips).zip(&findings.runs);
    let rows: Vec<(f64, Traced, &str)> =
        used.filter_map(|((row, slip), run)| Some(((*slip)?, (*row)?, run.as_str()))).collect();
    let x = span(rows.iter().map(|(slip, ..)| *slip));
    let extent = rows.iter().flat_map(|(_, row, _)| {
        let predicted = [row.before, row.after].into_iter().flatten();
        predicted.chain([row.measured - row.noise, row.measured + row.noise]).map(|value| quantity.factor * value)
    });
    let (Some(x), Some(y)) = (x, span(extent)) else { return html! {} };
    let title = quantity.titled();
    let captions = [findings.before_in_words(), findings.after_in_words()];
    Pair { title: &title, along: "slip", x, y, captions }.svg(|side, x, y| {
        html! {
            @for (slip, row, run) in rows.iter().step_by(stride(rows.len())) {
                (mark(side, row, (*slip, quantity.factor), (x, y), run))
            }
        }
    })
}

/// A prediction with its noise band, and the reading.
fn mark(side: Side, row: &Traced, (slip, factor): (f64, f64), (x, y): (&Scale, &Scale), run: &str) -> Markup {
    let place = x.at(slip);
    html! {
        @if let Some(predicted) = row.predicted(side) {
            (line(&format!("noise {}", side.class()),
                (place, y.at(factor * (predicted - row.noise))), (place, y.at(factor * (predicted + row.noise)))))
            (line(&format!("predicted {}", side.class()),
                (place - HALF, y.at(factor * predicted)), (place + HALF, y.at(factor * predicted))))
        }
        g { title { (run) } (dot("measured", (place, y.at(factor * row.measured)), 2.4)) }
    }
}

fn legend() -> Markup {
    let predicted = |side: Side| {
        html! {
            (line(&format!("noise {}", side.class()), (20.0, 1.0), (20.0, 15.0)))
            (line(&format!("predicted {}", side.class()), (15.5, 8.0), (24.5, 8.0)))
        }
    };
    html! {
        ul class="legend" {
            (entry("measured", &dot("measured", (20.0, 8.0), 2.4)))
            (entry("predicted before, ± one standard deviation of the noise", &predicted(Side::Before)))
            (entry("predicted after", &predicted(Side::After)))
        }
    }
}
