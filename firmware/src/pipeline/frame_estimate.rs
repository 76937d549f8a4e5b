//! What the pipeline says at each frame.

use serde::{Deserialize, Serialize};

use crate::estimator::{Estimate, WheelEstimate};
use crate::fusion::RoverSoil;
use crate::rover::{PerAxle, PerSide, PerWheel};
use crate::soil::{Refusal, SoilEstimate};

/// Everything that is known after a frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FrameEstimate {
    /// Time of the frame, µs.
    pub time_us: u64,
    /// Forces and motion of the wheels.
    pub wheels: PerWheel<WheelEstimate>,
    /// Drawbar pull of each bogie's two wheels together, N: what of theirs is observable.
    pub bogie_drawbar_pull_n: PerSide<Estimate>,
    /// The soil under each wheel by itself, from this instant alone.
    pub wheel_soils: PerWheel<Result<SoilEstimate, Refusal>>,
    /// The soil under the rover.
    pub soil: Result<RoverSoil, Refusal>,
}

impl FrameEstimate {
    /// That of a pipeline that has seen nothing yet.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn nothing() -> Self {
        Self {
            time_us: 0,
            wheels: PerWheel::default(),
            bogie_drawbar_pull_n: PerSide::default(),
            wheel_soils: PerSide::both(PerAxle::all(Err(Refusal::NotRolling))),
            soil: Err(Refusal::NotRolling),
        }
    }
}
