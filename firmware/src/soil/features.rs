//! The networks' inputs: dimensionless groups, so that one table serves wheels of many sizes and loads.

use crate::math;
use crate::network::{CONTEXT_FEATURES, WHEEL_FEATURES};
use crate::terramechanics::Wheel;
use crate::wheel_state::{SoilQuery, WheelNoise, WheelState};

/// Inputs of one wheel: DP/W, T/(rW), slip, z/r (0 where nobody measures it) and ln(W/(rb) / 10 kPa).
pub type WheelFeatures = [f32; WHEEL_FEATURES];

/// Inputs that the wheels share: ln(r / 0.1 m), ln(b/r), and the logarithms of the standard deviations of DP/W̄, W/W̄,
/// T/(rW̄), slip and z/r, W̄ being the mean load. A sinkage that nobody measures is one with a deviation of r.
pub type ContextFeatures = [f32; CONTEXT_FEATURES];

/// The inputs of one wheel; `sinkage` tells whether to use its sinkage.
pub fn wheel_features(wheel: &Wheel<f32>, state: &WheelState, sinkage: bool) -> WheelFeatures {
    let load = state.load_n;
    let r = wheel.radius_m;
    let depth = if sinkage { state.sinkage_m.unwrap_or(0.0) / r } else { 0.0 };
    [
        state.drawbar_pull_n / load,
        state.torque_nm / (r * load),
        state.slip,
        depth,
        math::ln(load / (r * wheel.width_m * 1.0e4)),
    ]
}

/// The inputs that the wheels share.
pub fn context_features(wheel: &Wheel<f32>, noise: &WheelNoise, mean_load_n: f32, sinkage: bool) -> ContextFeatures {
    let r = wheel.radius_m;
    let sinkage_std = if sinkage { noise.sinkage_m / r } else { 1.0 };
    [
        10.0 * r,
        wheel.width_m / r,
        noise.drawbar_pull_n / mean_load_n,
        noise.load_n / mean_load_n,
        noise.torque_nm / (r * mean_load_n),
        noise.slip,
        sinkage_std,
    ]
    .map(math::ln)
}

impl SoilQuery {
    /// Mean load of the wheels, N; NaN for no wheels.
    pub fn mean_load_n(&self) -> f32 {
        self.wheels.iter().map(|state| state.load_n).sum::<f32>() / self.wheels.len() as f32
    }

    /// Whether every wheel has its sinkage measured.
    pub fn has_sinkage(&self) -> bool {
        self.wheels.iter().all(|state| state.sinkage_m.is_some())
    }
}
