//! The networks' inputs: dimensionless groups, so that one table serves wheels of many sizes and loads.

use heapless::Vec;

use crate::math;
use crate::network::{CONTEXT_FEATURES, ROVER_CONTEXT, WHEEL_FEATURES, WHEEL_INPUTS, joined};
use crate::terramechanics::Wheel;
use crate::wheel_state::{Slope, SoilQuery, WHEELS, WheelNoise, WheelState};

use super::trend::{LoadSums, TrendNoise, trend};

/// Inputs of one wheel: DP/W, T/(rW), slip, the fifth input and ln(W/(rb) / 10 kPa).
pub type WheelFeatures = [f32; WHEEL_FEATURES];

/// Inputs that the wheels share: ln(r / 0.1 m), ln(b/r), and the logarithms of the standard deviations of DP/W̄, W/W̄,
/// T/(rW̄), slip and the fifth input, W̄ being the mean load.
type ContextFeatures = [f32; CONTEXT_FEATURES];

/// Inputs that the wheels of the rover network share: those above, and the trend over the wheels.
pub type RoverContext = [f32; ROVER_CONTEXT];

/// The input that a network may do without.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FifthInput {
    /// Its value.
    pub value: f32,
    /// One standard deviation.
    pub std: f32,
}

impl FifthInput {
    /// Not measured: so uncertain that its value is of no account.
    pub const UNKNOWN: Self = Self { value: 0.0, std: 1.0 };

    /// The fifth input of the per-wheel network: the slope under the rover, which tells the mean pull of all its wheels.
    pub fn slope(slope: Option<Slope>) -> Self {
        slope.map_or(Self::UNKNOWN, |slope| Self { value: slope.angle_rad, std: slope.std_rad })
    }

    /// The fifth input of the rover network: sinkage over radius.
    pub fn sinkage(wheel: &Wheel<f32>, state: &WheelState, noise: &WheelNoise) -> Self {
        let r = wheel.radius_m;
        state.sinkage_m.map_or(Self::UNKNOWN, |sinkage| Self { value: sinkage / r, std: noise.sinkage_m / r })
    }
}

/// The inputs of one wheel.
fn wheel_features(wheel: &Wheel<f32>, state: &WheelState, fifth: FifthInput) -> WheelFeatures {
    let load = state.load_n;
    let r = wheel.radius_m;
    [
        state.drawbar_pull_n / load,
        state.torque_nm / (r * load),
        state.slip,
        fifth.value,
        math::ln(load / (r * wheel.width_m * 1.0e4)),
    ]
}

/// Standard deviations of DP/W̄, W/W̄, T/(rW̄) and slip, W̄ being the mean load.
fn relative_noise(wheel: &Wheel<f32>, noise: &WheelNoise, mean_load_n: f32) -> [f32; 4] {
    let per_load = 1.0 / mean_load_n;
    let per_moment = per_load / wheel.radius_m;
    [per_load * noise.drawbar_pull_n, per_load * noise.load_n, per_moment * noise.torque_nm, noise.slip]
}

/// The inputs that the wheels share.
fn context_features(wheel: &Wheel<f32>, [pull, load, torque, slip]: [f32; 4], fifth: FifthInput) -> ContextFeatures {
    let r = wheel.radius_m;
    [10.0 * r, wheel.width_m / r, pull, load, torque, slip, fifth.std].map(math::ln)
}

impl SoilQuery {
    /// The fifth input of each wheel in the rover network: unknown for all where it is not known of all.
    pub fn sinkage_inputs(&self) -> impl Iterator<Item = FifthInput> + '_ {
        let seen = self.wheels.iter().all(|state| state.sinkage_m.is_some());
        self.wheels.iter().map(move |state| self.sinkage_input(state, seen))
    }

    fn sinkage_input(&self, state: &WheelState, seen: bool) -> FifthInput {
        if seen { FifthInput::sinkage(&self.wheel, state, &self.noise) } else { FifthInput::UNKNOWN }
    }

    /// The rover network's inputs: the shared ones, then those of each wheel. Of no wheels there are shared ones alone, some of them NaN.
    pub fn rover_features(&self) -> (RoverContext, Vec<WheelFeatures, WHEELS>) {
        // One pass for what all wheels say together.
        let (mut load_n, mut seen) = (0.0, true);
        for state in &self.wheels {
            load_n += state.load_n;
            seen &= state.sinkage_m.is_some();
        }
        let relative = relative_noise(&self.wheel, &self.noise, load_n / self.wheels.len() as f32);
        let mut fifth = FifthInput::UNKNOWN;
        let (mut wheels, mut loads) = (Vec::new(), LoadSums::default());
        for state in &self.wheels {
            if seen {
                fifth = FifthInput::sinkage(&self.wheel, state, &self.noise);
            }
            let features = wheel_features(&self.wheel, state, fifth);
            loads.add(&features);
            // Not `collect`: heapless panics where it overflows.
            let _ = wheels.push(features);
        }
        let context = context_features(&self.wheel, relative, fifth);
        let [pull, load, torque, slip] = relative;
        let noise = TrendNoise { pull, load, torque, slip, sinkage: seen.then_some(fifth.std) };
        (joined([&context, &trend(&wheels, loads, noise)]), wheels)
    }

    /// The per-wheel network's inputs for one wheel.
    pub fn wheel_inputs(&self, state: &WheelState, fifth: FifthInput) -> [f32; WHEEL_INPUTS] {
        let own = wheel_features(&self.wheel, state, fifth);
        let shared = context_features(&self.wheel, relative_noise(&self.wheel, &self.noise, state.load_n), fifth);
        joined([&own, &shared])
    }
}
