//! The soil under the rover.

use serde::{Deserialize, Serialize};

use crate::rover::PerWheel;
use crate::soil::SoilEstimate;

/// The soil under the rover, fused over time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RoverSoil {
    /// The fused estimate.
    pub estimate: SoilEstimate,
    /// Wheels that stand on the newest soil and take part, in the order of the files.
    pub wheels: PerWheel<bool>,
    /// How many independent instants the estimate is worth.
    pub instants: f32,
    /// Soil changes that were noticed since the start.
    pub changes: u16,
}
