//! What is asked for: parameters of the soil.

use kapvik_firmware::terramechanics::Soil;

use crate::parameter::Parameter;
/// A parameter that is asked for.
pub use crate::parameter::Parameter as Target;

impl Parameter {
    /// A standard deviation of ln c, φ or ln K as a share of the parameter's value.
    pub fn relative(self, std: f64, soil: &Soil<f64>) -> f64 {
        match self {
            Self::Cohesion | Self::ShearModulus => std,
            Self::FrictionAngle => std / soil.friction_angle_rad,
        }
    }
}
