//! What is known of the wheels at one instant: the input of the soil estimate.

use heapless::Vec;
use serde::{Deserialize, Serialize};

use crate::scalar::Scalar;
use crate::terramechanics::{SinkageError, Soil, Wheel, WheelTruth, sinkage_for_load, wheel_forces};

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

impl<S: Scalar> WheelState<S> {
    /// The state that equations 1–11 give a wheel at a slip under a load, N.
    ///
    /// # Errors
    /// Where the soil does not carry the load, or a number is out of its range.
    pub fn under_load(wheel: &Wheel<S>, soil: &Soil<S>, slip: S, load_n: S) -> Result<Self, SinkageError> {
        let sinkage_m = sinkage_for_load(wheel, soil, slip, load_n)?;
        let forces = wheel_forces(wheel, soil, slip, sinkage_m).map_err(|_| SinkageError::Input)?;
        let sinkage_m = Some(sinkage_m);
        Ok(Self { drawbar_pull_n: forces.drawbar_pull_n, load_n, torque_nm: forces.torque_nm, slip, sinkage_m })
    }

    /// The state with noise of these standard deviations; `normal` draws from the standard normal distribution.
    pub fn blurred(&self, noise: &WheelNoise<S>, mut normal: impl FnMut() -> S) -> Self {
        let mut blur = |value: S, std: S| value + std * normal();
        Self {
            drawbar_pull_n: blur(self.drawbar_pull_n, noise.drawbar_pull_n),
            load_n: blur(self.load_n, noise.load_n),
            torque_nm: blur(self.torque_nm, noise.torque_nm),
            slip: blur(self.slip, noise.slip),
            sinkage_m: self.sinkage_m.map(|sinkage_m| blur(sinkage_m, noise.sinkage_m)),
        }
    }
}

impl<S> From<WheelTruth<S>> for WheelState<S> {
    fn from(truth: WheelTruth<S>) -> Self {
        Self {
            drawbar_pull_n: truth.drawbar_pull_n,
            load_n: truth.load_n,
            torque_nm: truth.torque_nm,
            slip: truth.slip,
            sinkage_m: Some(truth.sinkage_m),
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
