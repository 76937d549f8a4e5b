//! What is printed of the soil of a run, or of a wheel: c, φ and K.

use kapvik_firmware::soil::SoilEstimate;
use serde::Serialize;

use crate::prior::{self, Range};

use super::method::{Finding, Statement};
use super::network::at_edge;

/// A soil; null in everything where there is no estimate.
#[derive(Debug, Clone, Default, Serialize)]
pub struct SoilDocument {
    /// c, Pa.
    pub cohesion_pa: Option<ParameterDocument>,
    /// φ, rad.
    pub friction_angle_rad: Option<ParameterDocument>,
    /// K, m.
    pub shear_modulus_m: Option<ParameterDocument>,
    #[serde(skip_serializing_if = "Option::is_none")]
    outside_training_range: Option<bool>,
}

/// One parameter.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct ParameterDocument {
    /// The value.
    pub value: f64,
    /// One standard deviation; null where neither the method nor the bootstrap gives one.
    pub std: Option<f64>,
    /// Whether the data tell it.
    pub identifiable: bool,
    /// Whether the method takes it as given.
    pub assumed: bool,
    /// At the end of what the networks were trained for, beyond which they cannot go: to be doubted, however narrow.
    #[serde(skip_serializing_if = "Option::is_none")]
    at_edge_of_training: Option<bool>,
    interval_68: [f64; 2],
    interval_95: [f64; 2],
}

impl SoilDocument {
    /// Calls nothing identifiable.
    pub(super) fn doubt(&mut self) {
        let parameters = [&mut self.cohesion_pa, &mut self.friction_angle_rad, &mut self.shear_modulus_m];
        parameters.into_iter().flatten().for_each(|parameter| parameter.identifiable = false);
    }

    /// What a method says.
    pub(super) fn of_method(found: &Finding) -> Self {
        let [cohesion, friction, shear] = found.statements().map(|statement| Some(ParameterDocument::of(statement)));
        Self {
            cohesion_pa: cohesion,
            friction_angle_rad: friction,
            shear_modulus_m: shear,
            outside_training_range: None,
        }
    }

    /// What a network says.
    pub(super) fn of_network(estimate: &SoilEstimate) -> Self {
        let mut soil = Self::of_method(&Finding::from(estimate));
        let at_edge_of = |parameter: &mut Option<ParameterDocument>, trained: Range| {
            if let Some(parameter) = parameter {
                parameter.at_edge_of_training = Some(at_edge(trained, parameter.value));
            }
        };
        at_edge_of(&mut soil.cohesion_pa, prior::COHESION_PA);
        at_edge_of(&mut soil.friction_angle_rad, prior::FRICTION_ANGLE_RAD);
        at_edge_of(&mut soil.shear_modulus_m, prior::SHEAR_MODULUS_M);
        Self { outside_training_range: Some(estimate.outside_training_range), ..soil }
    }
}

impl ParameterDocument {
    fn of(statement: &Statement) -> Self {
        Self {
            value: statement.value,
            std: Some(statement.std).filter(|std| std.is_finite()),
            identifiable: statement.identifiable,
            assumed: statement.assumed,
            at_edge_of_training: None,
            interval_68: statement.interval_68,
            interval_95: statement.interval_95,
        }
    }
}
