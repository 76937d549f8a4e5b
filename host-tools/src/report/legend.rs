//! What the marks of the pictures mean.

use maud::{Markup, html};

use super::caveats::kind_in_words;
use super::draw::{dot, line, path, ring, vertical_band};
use super::findings::{EstimateRow, RowKind};

const MIDDLE: f64 = 8.0;

/// The legend of the estimates.
pub fn estimates(rows: &[EstimateRow]) -> Markup {
    let bar = |class: &str| {
        html! {
            (line(&format!("thin {class}"), (1.0, MIDDLE), (39.0, MIDDLE)))
            (line(&format!("thick {class}"), (10.0, MIDDLE), (30.0, MIDDLE)))
        }
    };
    let has = |kind: RowKind| rows.iter().any(|row| row.kind == kind);
    html! {
        ul class="legend" {
            (entry("told by these data: value, 68 % and 95 % interval",
                &html! { (bar("told")) (dot("told", (20.0, MIDDLE), 4.0)) }))
            (entry("cannot be told from these data",
                &html! { (bar("untold")) (ring("untold", (20.0, MIDDLE), 4.0)) }))
            (entry("narrow, but in doubt: excludes the direct tests, lies at the edge of the training, belongs to such an estimate, or to a run that no soil explains",
                &html! { (bar("doubtful")) (dot("doubtful", (20.0, MIDDLE), 4.0)) }))
            (entry("direct tests of the same soil", &html! {
                (vertical_band("direct-band", (12.0, 28.0), (0.0, 16.0)))
                (line("direct", (20.0, 0.0), (20.0, 16.0)))
            }))
            (entry("taken to be possible before any data", &vertical_band("prior", (0.0, 40.0), (0.0, 16.0))))
        }
        p class="note" {
            @for (label, kind) in [
                ("Slip …", RowKind::Wheel),
                ("All", RowKind::RoverWithoutSinkage),
                ("All, with z", RowKind::RoverWithSinkage),
            ] {
                @if has(kind) { strong { (label) } ": " (kind_in_words(kind)) ". " }
            }
        }
    }
}

/// The legend of forces and sinkage over slip.
pub fn response(estimated: bool) -> Markup {
    html! {
        ul class="legend" {
            (entry("measured, ± one standard deviation", &html! {
                (line("deviation", (20.0, 1.0), (20.0, 15.0)))
                (dot("measured", (20.0, MIDDLE), 3.5))
            }))
            (entry("equations with the directly measured soil", &path("known", &[(0.0, MIDDLE), (40.0, MIDDLE)])))
            @if estimated {
                (entry("equations with c, φ and K of the networks", &path("estimated", &[(0.0, MIDDLE), (40.0, MIDDLE)])))
            }
        }
    }
}

/// One mark with its words.
pub(super) fn entry(words: &str, mark: &Markup) -> Markup {
    html! { li { svg width="40" height="16" viewBox="0 0 40 16" aria-hidden="true" { (mark) } (words) } }
}
