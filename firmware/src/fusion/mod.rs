//! Soil over time: what the networks say at each instant, averaged as it deserves, and started anew when the soil
//! changes.

mod resistance_watch;
mod rover_soil;
mod soil_average;
mod soil_change;
mod soil_over_time;
mod travel_mean;

pub use resistance_watch::{Stiffness, motion_resistance};
pub use rover_soil::RoverSoil;
pub use soil_change::SoilChangeDetector;
pub use soil_over_time::SoilOverTime;
