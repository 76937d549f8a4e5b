//! What a wheel does where its slip and its load are given, and how that changes with them and with the soil.

use kapvik_firmware::dual::Dual;
use kapvik_firmware::scalar::Scalar;
use kapvik_firmware::terramechanics::{Soil, Wheel, wheel_forces};
use nalgebra::{SMatrix, Vector3};

use super::coordinates::{Coordinates, DIMENSION, slopes_at, soil_at};

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
    /// Change with the soil at constant slip and load: with its coordinates, or with c, φ, K, n, k_φ, c₁ and c₂ themselves.
    pub by_soil: Slopes,
}

/// The sinkage has been found once a step changes its logarithm by less; what is left is corrected to first order.
const NEAR: f64 = 3e-3;
/// Newton steps before a load is given up.
const STEPS: usize = 20;
/// Sinkage over radius beyond which no load is looked for.
const BOTTOM: f64 = 0.9;

/// c, φ, K, n, k_φ, the share of the contact ahead of the peak stress (c₁ + c₂ i), slip, sinkage.
const VARIABLES: usize = 8;
const PEAK: usize = 5;
const SLIP: usize = 6;
const SINKAGE: usize = 7;

/// The response of a wheel on the soil at `point`, by the coordinates of the soil: see [`respond_to`].
pub fn respond(wheel: &Wheel<f64>, point: &Coordinates, slip: f64, load_n: f64, guess_m: f64) -> Option<Response> {
    let mut response = respond_to(wheel, &soil_at(point), slip, load_n, guess_m)?;
    for (mut column, scale) in response.by_soil.column_iter_mut().zip(slopes_at(point)) {
        column *= scale;
    }
    Some(response)
}

/// [`respond_to`] with the slopes at the very sinkage, too.
pub fn respond_exactly(wheel: &Wheel<f64>, soil: &Soil<f64>, slip: f64, load_n: f64) -> Option<Response> {
    let near = respond_to(wheel, soil, slip, load_n, 0.25 * wheel.radius_m)?;
    respond_to(wheel, soil, slip, load_n, near.value[2])
}

/// The response of a wheel on a soil, by the soil's own parameters (SI units), by Newton's method on ln W as a function of
/// ln z from `guess_m`; none where the soil carries the load at no sinkage up to 0.9 r.
pub fn respond_to(wheel: &Wheel<f64>, soil: &Soil<f64>, slip: f64, load_n: f64, guess_m: f64) -> Option<Response> {
    let mut sinkage_m = guess_m.clamp(1e-4 * wheel.radius_m, BOTTOM * wheel.radius_m);
    for _ in 0..STEPS {
        let (channels, load) = forces(wheel, soil, slip, sinkage_m)?;
        let load_by_ln_sinkage = load.slopes[SINKAGE] * sinkage_m;
        if !(load.value > 0.0 && load_by_ln_sinkage > 0.0) {
            return None;
        }
        let step = libm::log(load_n / load.value) * load.value / load_by_ln_sinkage;
        if step.abs() < NEAR {
            return Some(at_load(soil, slip, step * load_by_ln_sinkage, &channels, &load));
        }
        sinkage_m *= libm::exp(step.clamp(-1.0, 1.0));
        if sinkage_m > BOTTOM * wheel.radius_m {
            return None;
        }
    }
    None
}

/// From forces at a sinkage to the response at a load that is `missing_n` greater.
fn at_load(
    soil: &Soil<f64>,
    slip: f64,
    missing_n: f64,
    channels: &[Dual<f64, VARIABLES>; 3],
    load: &Dual<f64, VARIABLES>,
) -> Response {
    let by = |variable: usize| Channels::from(channels.map(|channel| channel.slopes[variable]));
    let by_load = by(SINKAGE) / load.slopes[SINKAGE];
    // A change at constant sinkage, less what brings the load back.
    let at_constant_load = |variable: usize| by(variable) - by_load * load.slopes[variable];
    let by_peak = at_constant_load(PEAK);
    let mut by_soil = Slopes::zeros();
    for (axis, mut column) in by_soil.column_iter_mut().enumerate() {
        let by_parameter = match axis {
            PEAK => by_peak,
            SLIP => by_peak * slip,
            _ => at_constant_load(axis),
        };
        column.copy_from(&by_parameter);
    }
    Response {
        value: Channels::from(channels.map(|channel| channel.value)) + by_load * missing_n,
        by_slip: at_constant_load(SLIP) + by_peak * soil.peak_stress_c2,
        by_load,
        by_soil,
    }
}

/// Drawbar pull, torque and sinkage, and the load, at a slip and a sinkage.
fn forces(
    wheel: &Wheel<f64>,
    soil: &Soil<f64>,
    slip: f64,
    sinkage_m: f64,
) -> Option<([Dual<f64, VARIABLES>; 3], Dual<f64, VARIABLES>)> {
    let constant = Dual::<f64, VARIABLES>::constant;
    let variable = Dual::<f64, VARIABLES>::variable;
    let wheel = Wheel { radius_m: constant(wheel.radius_m), width_m: constant(wheel.width_m) };
    let soil = Soil {
        cohesion_pa: variable(soil.cohesion_pa, 0),
        friction_angle_rad: variable(soil.friction_angle_rad, 1),
        shear_modulus_m: variable(soil.shear_modulus_m, 2),
        sinkage_exponent: variable(soil.sinkage_exponent, 3),
        frictional_modulus: variable(soil.frictional_modulus, 4),
        cohesive_modulus: constant(soil.cohesive_modulus),
        // Only the sum of c₁ and c₂ i counts: one variable instead of two.
        peak_stress_c1: variable(soil.peak_stress_c1 + soil.peak_stress_c2 * slip, PEAK),
        peak_stress_c2: constant(0.0),
        rebound_ratio: constant(soil.rebound_ratio),
    };
    let sinkage_m = variable(sinkage_m, SINKAGE);
    let found = wheel_forces(&wheel, &soil, variable(slip, SLIP), sinkage_m).ok()?;
    Some(([found.drawbar_pull_n, found.torque_nm, sinkage_m], found.load_n))
}
