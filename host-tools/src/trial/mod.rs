//! How well the estimators do on simulated drives: errors beside those of the raw sensors, coverage, consistency,
//! whiteness.

pub mod consistency;
mod drive;
pub mod errors;
pub mod faults;
mod flight_pipeline;
pub mod pulls_seen;
mod report;
pub mod soil_seen;
pub mod tally;
pub mod whiteness;

pub use drive::{Drive, Quantity, SOIL_LOOK_S, SoilPoint, WARM_UP_S};
pub use flight_pipeline::flight_pipeline;
pub use report::{Trial, errors_over, trial};
