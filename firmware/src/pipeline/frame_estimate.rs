//! What the pipeline says at each frame.

use serde::{Deserialize, Serialize};

use crate::estimator::WheelEstimate;
use crate::rover::PerWheel;
use crate::soil::{Refusal, SoilEstimate};

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

/// Everything that is known after a frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FrameEstimate {
    /// Time of the frame, µs.
    pub time_us: u64,
    /// Forces and motion of the wheels.
    pub wheels: PerWheel<WheelEstimate>,
    /// The soil under each wheel by itself, from this instant alone.
    pub wheel_soils: PerWheel<Result<SoilEstimate, Refusal>>,
    /// The soil under the rover.
    pub soil: Result<RoverSoil, Refusal>,
}
