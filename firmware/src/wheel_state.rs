//! What is known of the wheels at one instant: the input of the soil estimate.

use heapless::Vec;
use serde::{Deserialize, Serialize};

use crate::terramechanics::Wheel;

/// The most wheels that a query can hold: those of a rocker-bogie.
pub const WHEELS: usize = 6;

/// The state of one wheel at one instant, or its mean over a window.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WheelState<S = f32> {
    /// Drawbar pull DP, N, positive forward.
    pub drawbar_pull_n: S,
    /// Normal load W, N, positive downward.
    pub load_n: S,
    /// Resistive torque T, N·m.
    pub torque_nm: S,
    /// Slip i, −1 … 1.
    pub slip: S,
    /// Sinkage z, m, where something measures it.
    pub sinkage_m: Option<S>,
}

/// One standard deviation of each part of a [`WheelState`], independent from wheel to wheel.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WheelNoise<S = f32> {
    /// Of the drawbar pull, N.
    pub drawbar_pull_n: S,
    /// Of the load, N.
    pub load_n: S,
    /// Of the torque, N·m.
    pub torque_nm: S,
    /// Of the slip.
    pub slip: S,
    /// Of the sinkage, m; of no account where no wheel has one.
    pub sinkage_m: S,
}

impl<S> WheelState<S> {
    /// The same state in another scalar.
    pub fn map<T>(self, convert: impl Fn(S) -> T) -> WheelState<T> {
        WheelState {
            drawbar_pull_n: convert(self.drawbar_pull_n),
            load_n: convert(self.load_n),
            torque_nm: convert(self.torque_nm),
            slip: convert(self.slip),
            sinkage_m: self.sinkage_m.map(convert),
        }
    }
}

impl<S> WheelNoise<S> {
    /// The same noise in another scalar.
    pub fn map<T>(self, convert: impl Fn(S) -> T) -> WheelNoise<T> {
        WheelNoise {
            drawbar_pull_n: convert(self.drawbar_pull_n),
            load_n: convert(self.load_n),
            torque_nm: convert(self.torque_nm),
            slip: convert(self.slip),
            sinkage_m: convert(self.sinkage_m),
        }
    }
}

/// The slope that the rover drives on at steady speed: on plane ground the contact angle of all its wheels.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Slope {
    /// Against the horizontal, rad, positive uphill.
    pub angle_rad: f32,
    /// One standard deviation, rad.
    pub std_rad: f32,
}

/// Wheels of one size on one soil at one instant.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SoilQuery {
    /// The geometry that the wheels share.
    pub wheel: Wheel<f32>,
    /// How noisy the states are: of one instant, or of a mean of many.
    pub noise: WheelNoise,
    /// The slope under a rover that drives on all its wheels; none for a wheel in a rig.
    pub slope: Option<Slope>,
    /// One to six wheels.
    pub wheels: Vec<WheelState, WHEELS>,
}
