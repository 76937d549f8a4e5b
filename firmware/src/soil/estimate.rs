//! What is published of a soil: each parameter with its spread, and whether it can be told at all.

use serde::{Deserialize, Serialize};

use crate::math;
use crate::network::{Marginal, OUTPUTS, Posterior, PosteriorScale};

/// One parameter of the soil in its own unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ParameterEstimate {
    /// Posterior mean; for cohesion and shear modulus e to the posterior mean of the logarithm.
    pub value: f32,
    /// Posterior standard deviation; for cohesion and shear modulus that of a log-normal about `value`.
    pub std: f32,
    /// Contains the truth in 68 of 100 cases drawn from the prior.
    pub interval_68: [f32; 2],
    /// Contains the truth in 95 of 100 cases drawn from the prior.
    pub interval_95: [f32; 2],
    /// Whether the data removed at least half of the prior's variance and lie where the network was trained.
    pub identifiable: bool,
}

/// The soil under one wheel or under all of them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SoilEstimate {
    /// Cohesion c, Pa.
    pub cohesion_pa: ParameterEstimate,
    /// Angle of internal friction φ, rad.
    pub friction_angle_rad: ParameterEstimate,
    /// Shear deformation modulus K, m.
    pub shear_modulus_m: ParameterEstimate,
    /// Some input lies outside the range that the network was trained on: nothing here can be relied on.
    pub outside_training_range: bool,
}

/// Why there is no estimate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Refusal {
    /// The query holds no wheel.
    NoWheels,
    /// A number is NaN or infinite.
    NotFinite,
    /// Radius, width, load or a standard deviation is not above zero, or the slip is outside −1 … 1.
    OutOfRange,
    /// No wheel rolls under load with a slip that is known, or this one does not.
    NotRolling,
    /// The boot self-test found the network altered.
    SelfTestFailed,
}

impl SoilEstimate {
    /// From what a network puts out, on the scale of the prior that it was trained with.
    #[inline(never)] // one copy in the image for all networks
    pub fn of_outputs(scale: &PosteriorScale, outputs: &[f32; OUTPUTS], inside_training_range: bool) -> Self {
        Self::new(&scale.read(outputs), inside_training_range)
    }

    /// From the posterior of ln c, φ and ln K.
    pub fn new([ln_c, phi, ln_k]: &Posterior, inside_training_range: bool) -> Self {
        Self {
            cohesion_pa: from_logarithm(ln_c, inside_training_range),
            friction_angle_rad: ParameterEstimate {
                value: phi.mean,
                std: phi.std,
                interval_68: phi.interval_68,
                interval_95: phi.interval_95,
                identifiable: phi.identifiable && inside_training_range,
            },
            shear_modulus_m: from_logarithm(ln_k, inside_training_range),
            outside_training_range: !inside_training_range,
        }
    }
}

fn from_logarithm(marginal: &Marginal, inside_training_range: bool) -> ParameterEstimate {
    let value = math::exp(marginal.mean);
    let growth = math::exp(marginal.std * marginal.std);
    ParameterEstimate {
        value,
        std: value * math::sqrt(growth * (growth - 1.0)),
        interval_68: marginal.interval_68.map(math::exp),
        interval_95: marginal.interval_95.map(math::exp),
        identifiable: marginal.identifiable && inside_training_range,
    }
}
