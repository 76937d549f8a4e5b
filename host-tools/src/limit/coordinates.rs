//! Coordinates in which the prior of the soil is the standard normal distribution.
//!
//! Each parameter's share of its range is the normal distribution function of a coordinate. A box-shaped prior has no
//! edges there, so that a sampler needs no rule for them.

use kapvik_firmware::terramechanics::Soil;
use nalgebra::SVector;

use crate::train::prior::{self, Range};

/// Parameters that the prior of a soil draws.
pub const DIMENSION: usize = 7;

/// c, φ, K, n, k_φ, c₁, c₂, each as the normal quantile of its share of the prior's range.
pub type Coordinates = SVector<f64, DIMENSION>;

/// ln c (c in Pa), φ (rad), ln K (K in m): what is estimated.
pub type Targets = [f64; 3];

/// The soil at a point.
pub fn soil_at(point: &Coordinates) -> Soil<f64> {
    let value = |range: Range, place: usize| range.at(normal_distribution(point[place]));
    Soil {
        cohesion_pa: value(prior::COHESION_PA, 0),
        friction_angle_rad: value(prior::FRICTION_ANGLE_RAD, 1),
        shear_modulus_m: value(prior::SHEAR_MODULUS_M, 2),
        sinkage_exponent: value(prior::SINKAGE_EXPONENT, 3),
        frictional_modulus: value(prior::STIFFNESS, 4),
        cohesive_modulus: 0.0,
        peak_stress_c1: value(prior::PEAK_STRESS_C1, 5),
        peak_stress_c2: value(prior::PEAK_STRESS_C2, 6),
        rebound_ratio: 0.0,
    }
}

/// What is estimated of a soil.
pub fn targets_of(soil: &Soil<f64>) -> Targets {
    [libm::log(soil.cohesion_pa), soil.friction_angle_rad, libm::log(soil.shear_modulus_m)]
}

/// Distribution function of the standard normal.
pub fn normal_distribution(x: f64) -> f64 {
    0.5 * libm::erfc(-x * std::f64::consts::FRAC_1_SQRT_2)
}
