//! What a diagnosis found: a page to look at, and a summary for the terminal.

mod bars;
mod errors;
mod figures;
mod findings;
mod laws;
mod page;
mod pair;
mod prediction;
mod quantity;
mod ranking;
mod residual;
#[cfg(test)]
mod sample;
mod soil;
mod terminal;

pub use findings::DiagnosisFindings;
pub use page::page;
pub use quantity::Quantity;
pub use terminal::terminal;

/// How the charts of a diagnosis look: before is rust, after is blue.
const DIAGNOSIS_CSS: &str = include_str!("diagnosis.css");
