//! The three parameters of the soil, in the units that people read.

use kapvik_firmware::terramechanics::Soil;
use serde::Serialize;

/// Cohesion, friction angle or shear modulus.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Parameter {
    /// Cohesion c.
    Cohesion,
    /// Angle of internal friction φ.
    FrictionAngle,
    /// Shear deformation modulus K.
    ShearModulus,
}

impl Parameter {
    /// All three, in the order of the soil's parameters.
    pub const ALL: [Self; 3] = [Self::Cohesion, Self::FrictionAngle, Self::ShearModulus];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cohesion => "Cohesion",
            Self::FrictionAngle => "Friction angle",
            Self::ShearModulus => "Shear modulus",
        }
    }

    /// Its symbol.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Cohesion => "c",
            Self::FrictionAngle => "φ",
            Self::ShearModulus => "K",
        }
    }

    /// The unit that people read it in.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Cohesion => "Pa",
            Self::FrictionAngle => "°",
            Self::ShearModulus => "mm",
        }
    }

    /// Symbol and unit, for the head of a table.
    pub fn titled(self) -> String {
        format!("{}, {}", self.symbol(), self.unit())
    }

    /// Its key in the table `[soil]` of a campaign's description.
    pub fn key(self) -> &'static str {
        match self {
            Self::Cohesion => "c",
            Self::FrictionAngle => "phi",
            Self::ShearModulus => "K",
        }
    }

    /// Its value of a soil, SI.
    pub fn of_soil(self, soil: &Soil<f64>) -> f64 {
        match self {
            Self::Cohesion => soil.cohesion_pa,
            Self::FrictionAngle => soil.friction_angle_rad,
            Self::ShearModulus => soil.shear_modulus_m,
        }
    }

    /// Decimals that say something, in the unit that people read.
    pub fn decimals(self) -> usize {
        if self == Self::Cohesion { 0 } else { 1 }
    }

    /// A number in SI units, in the unit that people read.
    pub fn shown(self, si: f64) -> f64 {
        match self {
            Self::Cohesion => si,
            Self::FrictionAngle => si.to_degrees(),
            Self::ShearModulus => 1e3 * si,
        }
    }

    /// A standard deviation of ln c, φ (rad) or ln K as a share of the parameter's value.
    pub fn relative(self, std: f64, soil: &Soil<f64>) -> f64 {
        match self {
            Self::Cohesion | Self::ShearModulus => std,
            Self::FrictionAngle => std / soil.friction_angle_rad,
        }
    }
}
