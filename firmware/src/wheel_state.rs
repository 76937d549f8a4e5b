//! What a wheel feels: the input of the soil estimate.

use heapless::Vec;
use serde::{Deserialize, Serialize};

use crate::terramechanics::Wheel;

/// The most wheels that one query carries: those of a rocker-bogie rover.
pub const MAX_WHEELS: usize = 6;

/// The state of one wheel at one instant, or its mean over several.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WheelState {
    /// Drawbar pull DP, N, positive forward.
    pub drawbar_pull_n: f32,
    /// Normal load W, N, positive downward on the soil.
    pub load_n: f32,
    /// Resistive torque T, N·m, positive when the soil resists forward rotation.
    pub torque_nm: f32,
    /// Slip, −1 … 1; negative when braking.
    pub slip: f32,
    /// Sinkage, m, positive downward; absent where no sensor measures it.
    pub sinkage_m: Option<f32>,
}

/// One standard deviation of each channel of a [`WheelState`], in the channel's own unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WheelNoise {
    /// Of the drawbar pull, N.
    pub drawbar_pull_n: f32,
    /// Of the load, N.
    pub load_n: f32,
    /// Of the torque, N·m.
    pub torque_nm: f32,
    /// Of the slip.
    pub slip: f32,
    /// Of the sinkage, m.
    pub sinkage_m: f32,
}

/// A question for the flight computer: what soil do these wheels stand on?
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SoilQuery {
    /// The wheel, the same for all.
    pub wheel: Wheel<f32>,
    /// How noisy the states are; the mean of N instants is √N times quieter than one.
    pub noise: WheelNoise,
    /// The wheels of one instant, one to six.
    pub wheels: Vec<WheelState, MAX_WHEELS>,
}
