//! What more than one set of tests drives: Kapvik's wheel, on the seed's sand.

use kapvik_firmware::terramechanics::{Soil, Wheel};

/// A wheel of Kapvik's assumed size.
pub const fn kapvik_wheel() -> Wheel<f64> {
    Wheel { radius_m: 0.075, width_m: 0.070 }
}

/// The seed's Table 1.
pub const fn table_1_sand() -> Soil<f64> {
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
