//! What is known of the soil before the wheels roll.

use clap::ValueEnum;
use kapvik_firmware::identification::SoilPrior;
use kapvik_firmware::terramechanics::{Soil, Wheel};
use nalgebra::SMatrix;
use serde::Serialize;

use crate::identify::method::{Assumed, training_prior};
use crate::limit::coordinates::DIMENSION;

/// Parameters of a soil in a bound: ln c, φ, ln K, n, ln(k_c/b + k_φ), c₁, c₂, in this order.
pub const PARAMETERS: usize = DIMENSION;

/// How well parameters are known beforehand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Knowledge {
    /// Exactly.
    Known,
    /// As well as the usual prior has it: its standard deviations, about the stated soil.
    Prior,
    /// As well as the prior that the networks are trained with has it: the standard deviations of its ranges, about the
    /// stated soil.
    Training,
    /// Not at all.
    Free,
}

/// What is known of the soil beforehand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Beforehand {
    /// Of ln c, φ and ln K.
    pub targets: Knowledge,
    /// Of n and the stiffness.
    pub pressure: Knowledge,
    /// Of c₁ and c₂.
    pub peak: Knowledge,
}

/// A parameter as the bound computes with it: in units of `scale`, with the information `precision` beforehand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standardised {
    /// The unit.
    pub scale: f64,
    /// Information beforehand: 1 or none.
    pub precision: f64,
}

impl Knowledge {
    /// How well, in words.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Known => "exactly",
            Self::Prior => "as the usual prior has them",
            Self::Training => "as the networks' training prior has them",
            Self::Free => "not at all",
        }
    }
}

impl Default for Beforehand {
    fn default() -> Self {
        Self { targets: Knowledge::Prior, pressure: Knowledge::Prior, peak: Knowledge::Prior }
    }
}

impl Beforehand {
    /// Every parameter in units of what is known of it.
    pub fn standardised(&self) -> [Standardised; PARAMETERS] {
        let Self { targets, pressure, peak } = *self;
        let knowledge = [targets, targets, targets, pressure, pressure, peak, peak];
        let (usual, trained_with) = (prior_stds(), stds(&training_prior()));
        std::array::from_fn(|place| match knowledge[place] {
            Knowledge::Known => Standardised { scale: 0.0, precision: 1.0 },
            Knowledge::Prior => Standardised { scale: usual[place], precision: 1.0 },
            Knowledge::Training => Standardised { scale: trained_with[place], precision: 1.0 },
            Knowledge::Free => Standardised { scale: 1.0, precision: 0.0 },
        })
    }
}

/// Standard deviations of the usual prior.
pub fn prior_stds() -> [f64; PARAMETERS] {
    stds(&SoilPrior::usual())
}

/// Of a flat belief, that of its range.
fn stds(prior: &SoilPrior<f64>) -> [f64; PARAMETERS] {
    [
        prior.ln_cohesion,
        prior.friction_angle_rad,
        prior.ln_shear_modulus,
        prior.sinkage_exponent,
        prior.ln_stiffness,
        prior.peak_stress_c1,
        prior.peak_stress_c2,
    ]
    .map(|belief| belief.std.unwrap_or((belief.high - belief.low) / libm::sqrt(12.0)))
}

/// The soil in the middle of the usual prior.
pub fn middle_soil() -> Soil<f64> {
    Assumed::middle_of(&SoilPrior::usual()).soil
}

/// Changes with c, φ, K, n, k_φ, c₁, c₂ as changes with the parameters of a bound.
pub fn by_parameters<const C: usize>(
    mut by_soil: SMatrix<f64, C, PARAMETERS>,
    wheel: &Wheel<f64>,
    soil: &Soil<f64>,
) -> SMatrix<f64, C, PARAMETERS> {
    let by_logarithm = [(0, soil.cohesion_pa), (2, soil.shear_modulus_m), (4, soil.stiffness(wheel.width_m))];
    for (place, value) in by_logarithm {
        by_soil.column_mut(place).scale_mut(value);
    }
    by_soil
}
