//! The three parameters that are asked for.

use kapvik_firmware::terramechanics::Soil;
use serde::Serialize;

/// A parameter that is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Target {
    /// Cohesion c.
    Cohesion,
    /// Angle of internal friction φ.
    FrictionAngle,
    /// Shear deformation modulus K.
    ShearModulus,
}

impl Target {
    /// All three, in the order of the soil's parameters.
    pub const ALL: [Self; 3] = [Self::Cohesion, Self::FrictionAngle, Self::ShearModulus];

    /// Its symbol.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Cohesion => "c",
            Self::FrictionAngle => "φ",
            Self::ShearModulus => "K",
        }
    }

    /// A standard deviation of ln c, φ or ln K as a share of the parameter's value.
    pub fn relative(self, std: f64, soil: &Soil<f64>) -> f64 {
        match self {
            Self::Cohesion | Self::ShearModulus => std,
            Self::FrictionAngle => std / soil.friction_angle_rad,
        }
    }
}
