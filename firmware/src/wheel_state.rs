//! What is known of the wheels at one instant: the input of the soil estimate.

use heapless::Vec;
use serde::{Deserialize, Serialize};

use crate::terramechanics::Wheel;

/// The most wheels that a query can hold: those of a rocker-bogie.
pub const WHEELS: usize = 6;

/// The state of one wheel at one instant, or its mean over a window.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WheelState {
    /// Drawbar pull DP, N, positive forward.
    pub drawbar_pull_n: f32,
    /// Normal load W, N, positive downward.
    pub load_n: f32,
    /// Resistive torque T, N·m.
    pub torque_nm: f32,
    /// Slip i, −1 … 1.
    pub slip: f32,
    /// Sinkage z, m, where something measures it.
    pub sinkage_m: Option<f32>,
}

/// One standard deviation of each part of a [`WheelState`], independent from wheel to wheel.
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
    /// Of the sinkage, m; of no account where no wheel has one.
    pub sinkage_m: f32,
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
