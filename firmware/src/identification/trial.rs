//! Six wheels at one instant on which the cost of the methods is counted.

use crate::terramechanics::{Soil, Wheel, sinkage_for_load, wheel_forces};
use crate::wheel_state::{WheelNoise, WheelState};

use super::Observation;

/// Kapvik's, as it is assumed.
pub const WHEEL: Wheel<f32> = Wheel { radius_m: 0.075, width_m: 0.07 };
/// Of one instant.
const NOISE: WheelNoise<f32> =
    WheelNoise { drawbar_pull_n: 0.5, load_n: 1.0, torque_nm: 0.05, slip: 0.01, sinkage_m: 0.002 };
/// Slip and load (N) of each wheel.
const WHEELS: [(f32, f32); 6] = [(0.05, 45.0), (0.16, 80.0), (0.27, 55.0), (0.38, 90.0), (0.49, 65.0), (0.60, 50.0)];
/// What faultless sensors read on a soil that carries the wheels.
pub fn six_wheels(soil: &Soil<f32>) -> Option<[Observation<f32>; 6]> {
    let mut seen = [Observation { state: state(0.0, 0.0), noise: NOISE }; 6];
    for (observation, (slip, load_n)) in seen.iter_mut().zip(WHEELS) {
        let sinkage_m = sinkage_for_load(&WHEEL, soil, slip, load_n).ok()?;
        let forces = wheel_forces(&WHEEL, soil, slip, sinkage_m).ok()?;
        observation.state = WheelState {
            drawbar_pull_n: forces.drawbar_pull_n,
            torque_nm: forces.torque_nm,
            sinkage_m: Some(sinkage_m),
            ..state(slip, load_n)
        };
    }
    Some(seen)
}

fn state(slip: f32, load_n: f32) -> WheelState<f32> {
    WheelState { drawbar_pull_n: 0.0, load_n, torque_nm: 0.0, slip, sinkage_m: None }
}

/// The same with the first wheel's torque `off` standard deviations off, so that no two calls are alike.
pub fn with_error(seen: &[Observation<f32>; 6], off: f32) -> [Observation<f32>; 6] {
    let mut seen = *seen;
    seen.iter_mut().take(1).for_each(|first| first.state.torque_nm += off * NOISE.torque_nm);
    seen
}
