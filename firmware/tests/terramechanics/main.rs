//! The wheel–soil equations against closed forms, limits, published figures and integrations made elsewhere.

mod effects;
mod limits;
mod properties;
mod published;
mod reference;
mod sinkage;
mod vectors;

use kapvik_firmware::terramechanics::{Soil, Wheel, WheelForces, wheel_forces};

/// A wheel of Kapvik's assumed size.
const fn kapvik_wheel() -> Wheel<f64> {
    Wheel { radius_m: 0.075, width_m: 0.070 }
}

/// The seed's Table 1.
const fn table_1_sand() -> Soil<f64> {
    Soil {
        sinkage_exponent: 1.1,
        cohesive_modulus: 15_600.0,
        frictional_modulus: 2_407_400.0,
        cohesion_pa: 250.0,
        friction_angle_rad: 31.9_f64.to_radians(),
        shear_modulus_m: 0.0114,
        peak_stress_c1: 0.18,
        peak_stress_c2: 0.32,
        rebound_ratio: 0.0,
    }
}

/// Forces where the inputs are known to be in range.
fn forces(wheel: &Wheel<f64>, soil: &Soil<f64>, slip: f64, sinkage_m: f64) -> WheelForces<f64> {
    wheel_forces(wheel, soil, slip, sinkage_m).expect("inputs in range")
}
