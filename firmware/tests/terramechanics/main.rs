//! The wheel–soil equations against closed forms, limits, published figures and integrations made elsewhere.

mod effects;
mod effects_closed_forms;
#[path = "../support/kapvik.rs"]
mod kapvik;
mod limits;
#[path = "../support/mostly.rs"]
mod mostly;
mod properties;
mod published;
mod reference;
mod sinkage;
mod vectors;

use kapvik::{kapvik_wheel, table_1_sand};
use kapvik_firmware::terramechanics::{Soil, Wheel, WheelForces, wheel_forces};

/// Forces where the inputs are known to be in range.
fn forces(wheel: &Wheel<f64>, soil: &Soil<f64>, slip: f64, sinkage_m: f64) -> WheelForces<f64> {
    wheel_forces(wheel, soil, slip, sinkage_m).expect("inputs in range")
}
