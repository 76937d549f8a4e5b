//! The way from the measurements to the soil, as a row of boxes.

use maud::{Markup, html};

use crate::digits::counted;
use crate::flight_computer::Computer;

use super::findings::Findings;

/// The boxes, each with what it did this time.
pub fn chain(findings: &Findings) -> Markup {
    let queries = findings.flight.health.queries_answered;
    let (place, line) = match findings.flight.computer {
        Computer::Qemu => ("Flight image", "on a Cortex-M4F in QEMU"),
        Computer::Host => ("Flight library", "in this process"),
    };
    let used: usize = findings.identification.runs.iter().map(|run| run.states.rows_used).sum();
    html! {
        ol class="chain" {
            (link("Wheel states", &format!("{used} rows, {}", findings.campaign.provenance), "DP, W, T, slip, sinkage"))
            (link("Serial link", &counted(queries.into(), "query", "queries"), "postcard, COBS, CRC-32"))
            (link(place, line, "frozen networks, 16-bit whole numbers"))
            (link("Soil", "c, φ, K", "each with its interval"))
        }
    }
}

/// A box.
pub(super) fn link(title: &str, what: &str, how: &str) -> Markup {
    html! { li { strong { (title) } span { (what) } small { (how) } } }
}
