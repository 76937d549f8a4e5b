//! Coordinates in which the prior of the soil is the standard normal distribution.
//!
//! Each parameter's share of its range is the normal distribution function of a coordinate. A box-shaped prior has no
//! edges there, so that a sampler needs no rule for them.

use kapvik_firmware::network::TARGETS;
use kapvik_firmware::terramechanics::Soil;
use nalgebra::SVector;

use crate::prior::{self, Range, SOIL_RANGES};
use crate::train::example::soil_targets;

/// Parameters that the prior of a soil draws.
pub const DIMENSION: usize = prior::SOIL_PARAMETERS;

/// c, φ, K, n, k_φ, c₁, c₂, each as the normal quantile of its share of the prior's range.
pub type Coordinates = SVector<f64, DIMENSION>;

/// ln c (c in Pa), φ (rad), ln K (K in m): what is estimated.
pub type Targets = [f64; TARGETS];

/// The soil at a point.
pub fn soil_at(point: &Coordinates) -> Soil<f64> {
    prior::soil(parameters_at(point))
}

fn parameters_at(point: &Coordinates) -> [f64; DIMENSION] {
    std::array::from_fn(|axis| SOIL_RANGES[axis].at(normal_distribution(point[axis])))
}

/// Change of each parameter with its own coordinate.
pub fn slopes_at(point: &Coordinates) -> [f64; DIMENSION] {
    let parameters = parameters_at(point);
    std::array::from_fn(|axis| {
        let Range { low, high, logarithmic } = SOIL_RANGES[axis];
        let by_share = if logarithmic { parameters[axis] * libm::log(high / low) } else { high - low };
        by_share * normal_density(point[axis])
    })
}

/// What is estimated of the soil at a point.
pub fn targets_at(point: &Coordinates) -> Targets {
    soil_targets(&soil_at(point))
}

/// Distribution function of the standard normal.
pub fn normal_distribution(x: f64) -> f64 {
    0.5 * libm::erfc(-x * std::f64::consts::FRAC_1_SQRT_2)
}

fn normal_density(x: f64) -> f64 {
    0.5 * std::f64::consts::FRAC_2_SQRT_PI * std::f64::consts::FRAC_1_SQRT_2 * libm::exp(-0.5 * x * x)
}
