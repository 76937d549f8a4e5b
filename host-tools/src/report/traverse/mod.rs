//! What a drive told: forces and soil over time, as a page to look at, a picture, and a table for the terminal.

mod caveats;
mod doubts;
mod errors;
mod findings;
mod gather;
mod page;
mod picture;
mod samples;
mod soil_chart;
mod terminal;
mod time_axis;
mod wheel_chart;

pub use findings::{Origin, TraverseFindings};
pub use gather::Source;
pub use page::page;
pub use picture::picture;
pub use terminal::terminal;

/// How charts over time look.
const CHART_CSS: &str = include_str!("chart.css");
