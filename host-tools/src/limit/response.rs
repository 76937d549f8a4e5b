//! What a wheel does where its slip and its load are given, and how that changes with them and with the soil.

use kapvik_firmware::terramechanics::{Soil, Wheel, WheelForces, wheel_forces};
use nalgebra::{SMatrix, Vector3};

use super::coordinates::{Coordinates, DIMENSION, soil_at};

/// Drawbar pull (N), torque (N·m) and sinkage (m), in this order.
pub type Channels = Vector3<f64>;

/// Change of the channels with each coordinate of the soil.
pub type Slopes = SMatrix<f64, 3, DIMENSION>;

/// A wheel's response at a slip, a load and a soil, to first order in all of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    /// At the given slip, load and soil.
    pub value: Channels,
    /// Change with slip at constant load.
    pub by_slip: Channels,
    /// Change with load (N) at constant slip.
    pub by_load: Channels,
    /// Change with the soil at constant slip and load.
    pub by_soil: Slopes,
}

/// Relative step of the sinkage for its slopes.
const SINKAGE_STEP: f64 = 1e-4;
/// Step of the slip for its slopes.
const SLIP_STEP: f64 = 1e-4;
/// Step of a coordinate for its slopes.
const COORDINATE_STEP: f64 = 1e-4;
/// The sinkage has been found once a step changes its logarithm by less; what is left is corrected to first order.
const NEAR: f64 = 3e-3;
/// Newton steps before a load is given up.
const STEPS: usize = 20;
/// Sinkage over radius beyond which no load is looked for.
const BOTTOM: f64 = 0.9;

/// Channels and load at a sinkage, and their changes with its logarithm.
struct Foothold {
    sinkage_m: f64,
    channels: Channels,
    load_n: f64,
    by_ln_sinkage: Channels,
    load_by_ln_sinkage: f64,
}

/// The response of a wheel on the soil at `point`, by Newton's method on ln W as a function of ln z from `guess_m`; none
/// where the soil carries the load at no sinkage up to 0.9 r.
pub fn respond(wheel: &Wheel<f64>, point: &Coordinates, slip: f64, load_n: f64, guess_m: f64) -> Option<Response> {
    let soil = soil_at(point);
    let (foot, step) = foothold(wheel, &soil, slip, load_n, guess_m)?;
    let by_load = foot.by_ln_sinkage / foot.load_by_ln_sinkage;
    // A change at constant sinkage, less what brings the load back.
    let change = |soil: &Soil<f64>, slip: f64, step: f64| {
        let (channels, load_n) = at(wheel, soil, slip, foot.sinkage_m)?;
        Some((channels - foot.channels - by_load * (load_n - foot.load_n)) / step)
    };
    let mut by_soil = Slopes::zeros();
    for (axis, mut column) in by_soil.column_iter_mut().enumerate() {
        let beside = soil_at(&(point + Coordinates::ith(axis, COORDINATE_STEP)));
        column.copy_from(&change(&beside, slip, COORDINATE_STEP)?);
    }
    Some(Response {
        value: foot.channels + foot.by_ln_sinkage * step,
        by_slip: change(&soil, slip + SLIP_STEP, SLIP_STEP)?,
        by_load,
        by_soil,
    })
}

/// A sinkage that carries almost the given load, and the step of its logarithm that is left.
fn foothold(wheel: &Wheel<f64>, soil: &Soil<f64>, slip: f64, load_n: f64, guess_m: f64) -> Option<(Foothold, f64)> {
    let mut sinkage_m = guess_m.clamp(1e-4 * wheel.radius_m, BOTTOM * wheel.radius_m);
    for _ in 0..STEPS {
        let (channels, load_here_n) = at(wheel, soil, slip, sinkage_m)?;
        let (deeper, load_deeper_n) = at(wheel, soil, slip, sinkage_m * (1.0 + SINKAGE_STEP))?;
        let load_by_ln_sinkage = (load_deeper_n - load_here_n) / SINKAGE_STEP;
        if !(load_here_n > 0.0 && load_by_ln_sinkage > 0.0) {
            return None;
        }
        let step = libm::log(load_n / load_here_n) * load_here_n / load_by_ln_sinkage;
        if step.abs() < NEAR {
            let by_ln_sinkage = (deeper - channels) / SINKAGE_STEP;
            return Some((
                Foothold { sinkage_m, channels, load_n: load_here_n, by_ln_sinkage, load_by_ln_sinkage },
                step,
            ));
        }
        sinkage_m *= libm::exp(step.clamp(-1.0, 1.0));
        if sinkage_m > BOTTOM * wheel.radius_m {
            return None;
        }
    }
    None
}

/// Channels and load (N) at a slip and a sinkage.
fn at(wheel: &Wheel<f64>, soil: &Soil<f64>, slip: f64, sinkage_m: f64) -> Option<(Channels, f64)> {
    let WheelForces { drawbar_pull_n, load_n, torque_nm } = wheel_forces(wheel, soil, slip, sinkage_m).ok()?;
    Some((Channels::new(drawbar_pull_n, torque_nm, sinkage_m), load_n))
}
