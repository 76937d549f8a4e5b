//! What the wheels say about the soil: the output of the soil estimate.

use heapless::Vec;
use serde::{Deserialize, Serialize};

use crate::wheel_state::MAX_WHEELS;

/// A soil parameter with its uncertainty, in the parameter's own unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ParameterEstimate {
    /// The estimate.
    pub value: f32,
    /// One standard deviation.
    pub std: f32,
    /// The interval that holds the truth 68 times in 100.
    pub interval_68: [f32; 2],
    /// The interval that holds the truth 95 times in 100.
    pub interval_95: [f32; 2],
    /// Whether the wheels told more than was known before they were asked.
    pub identifiable: bool,
}

/// The soil under a wheel, or under the rover.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SoilEstimate {
    /// Cohesion c, Pa.
    pub cohesion_pa: ParameterEstimate,
    /// Angle of internal friction φ, rad.
    pub friction_angle_rad: ParameterEstimate,
    /// Shear deformation modulus K, m.
    pub shear_modulus_m: ParameterEstimate,
    /// An input lies outside the range that the network was trained on: the estimate is an extrapolation.
    pub outside_training_range: bool,
}

/// Why there is no estimate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Refusal {
    /// The query has no wheel.
    NoWheels,
    /// An input is infinite or not a number.
    NotFinite,
    /// An input has no physical meaning: a slip beyond ±1, a load, radius, width or noise that is not positive.
    OutOfRange,
    /// The image carries no network for this question.
    NoNetwork,
    /// The boot self-test failed: the table cannot be trusted.
    SelfTestFailed,
}

/// The answer to a [`crate::wheel_state::SoilQuery`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct QueryAnswer {
    /// For each wheel of the query, in its order, what that wheel says by itself.
    pub wheels: Vec<Result<SoilEstimate, Refusal>, MAX_WHEELS>,
    /// What all the wheels say together.
    pub rover: Result<SoilEstimate, Refusal>,
}

impl QueryAnswer {
    /// The same refusal for the rover and for each of `wheels` wheels.
    pub fn refused(wheels: usize, reason: Refusal) -> Self {
        let mut answer = Self { wheels: Vec::new(), rover: Err(reason) };
        (0..wheels).for_each(|_| answer.push(Err(reason)));
        answer
    }

    /// Adds what the next wheel says. A query has no more wheels than an answer has room for.
    pub fn push(&mut self, wheel: Result<SoilEstimate, Refusal>) {
        // Not `collect`: heapless panics where it overflows.
        let _ = self.wheels.push(wheel);
    }
}
