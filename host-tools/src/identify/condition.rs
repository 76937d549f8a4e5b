//! How well what was measured determines the soil: the condition number of the noise-whitened Jacobian.

use kapvik_firmware::terramechanics::{Soil, Wheel, WheelForces, sinkage_for_load, wheel_forces};
use kapvik_firmware::wheel_state::WheelNoise;
use nalgebra::{DMatrix, RowVector3};

use super::combine::MeanState;

/// Step of ln c, φ (rad) and ln K in the central differences.
const STEP: f64 = 1e-3;

/// Greatest over least singular value of the derivatives of DP, W and T of every wheel, each divided by its standard
/// deviation, with respect to ln c, φ and ln K. Each wheel is held at the sinkage at which `soil` carries its load.
///
/// None where `soil` does not carry a wheel, or three parameters cannot be told at all.
pub fn condition_number(wheel: &Wheel<f64>, soil: &Soil<f64>, states: &[MeanState], noise: &WheelNoise) -> Option<f64> {
    let mut jacobian = DMatrix::zeros(3 * states.len(), 3);
    for (place, state) in states.iter().enumerate() {
        let (slip, load_n) = (state.mean.slip, state.mean.load_n);
        let sinkage_m = sinkage_for_load(wheel, soil, slip, load_n).ok()?;
        let forces = |parameter, step| wheel_forces(wheel, &moved(soil, parameter, step), slip, sinkage_m).ok();
        for parameter in 0..3 {
            let (above, below) = (forces(parameter, STEP)?, forces(parameter, -STEP)?);
            let derivative = (whitened(&above, noise) - whitened(&below, noise)) / (2.0 * STEP);
            jacobian.view_mut((3 * place, parameter), (3, 1)).copy_from(&derivative.transpose());
        }
    }
    let values = jacobian.svd(false, false).singular_values;
    let condition = values.max() / values.min();
    condition.is_finite().then_some(condition)
}

fn whitened(forces: &WheelForces<f64>, noise: &WheelNoise) -> RowVector3<f64> {
    RowVector3::new(
        forces.drawbar_pull_n / f64::from(noise.drawbar_pull_n),
        forces.load_n / f64::from(noise.load_n),
        forces.torque_nm / f64::from(noise.torque_nm),
    )
}

/// The soil with ln c, φ or ln K moved by a step.
fn moved(soil: &Soil<f64>, parameter: usize, step: f64) -> Soil<f64> {
    let mut soil = *soil;
    match parameter {
        0 => soil.cohesion_pa *= step.exp(),
        1 => soil.friction_angle_rad += step,
        _ => soil.shear_modulus_m *= step.exp(),
    }
    soil
}
