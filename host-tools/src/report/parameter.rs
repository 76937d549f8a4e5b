//! The three parameters in the units that people read.

use kapvik_firmware::soil::{ParameterEstimate, SoilEstimate};

use crate::data::campaign::{Ground, Knowledge};
use crate::train::prior::{self, Range};

use super::draw::{Pixels, Scale};

/// Cohesion, friction angle or shear modulus.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parameter {
    /// Cohesion c.
    Cohesion,
    /// Angle of internal friction φ.
    FrictionAngle,
    /// Shear deformation modulus K.
    ShearModulus,
}

impl Parameter {
    /// All three.
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

    /// A number in SI units, in the unit that people read.
    pub fn shown(self, si: f64) -> f64 {
        match self {
            Self::Cohesion => si,
            Self::FrictionAngle => si.to_degrees(),
            Self::ShearModulus => 1e3 * si,
        }
    }

    /// The estimate of it.
    pub fn of(self, soil: &SoilEstimate) -> &ParameterEstimate {
        match self {
            Self::Cohesion => &soil.cohesion_pa,
            Self::FrictionAngle => &soil.friction_angle_rad,
            Self::ShearModulus => &soil.shear_modulus_m,
        }
    }

    /// What is known of it by other means.
    pub fn known(self, ground: &Ground) -> Option<Knowledge> {
        match self {
            Self::Cohesion => ground.cohesion_pa,
            Self::FrictionAngle => ground.friction_angle_rad,
            Self::ShearModulus => ground.shear_modulus_m,
        }
    }

    /// The range that the networks were trained with: what they take to be possible before any data.
    pub fn prior(self) -> Range {
        match self {
            Self::Cohesion => prior::COHESION_PA,
            Self::FrictionAngle => prior::FRICTION_ANGLE_RAD,
            Self::ShearModulus => prior::SHEAR_MODULUS_M,
        }
    }

    /// A scale over the prior with some room, in the shown unit.
    pub fn scale(self, pixels: Pixels) -> Scale {
        let range = self.prior();
        let (low, high) = (self.shown(range.low), self.shown(range.high));
        if range.logarithmic {
            let room = (high / low).powf(0.06);
            Scale::logarithmic(low / room, high * room, pixels)
        } else {
            let room = 0.06 * (high - low);
            Scale::linear(low - room, high + room, pixels)
        }
    }

    /// A number in SI units as text, without its unit: as many digits as the estimate can bear.
    pub fn number(self, si: f64) -> String {
        let shown = self.shown(si);
        match self {
            Self::Cohesion if shown >= 100.0 => format!("{}", (shown / 10.0).round() * 10.0),
            Self::Cohesion => format!("{shown:.0}"),
            Self::FrictionAngle | Self::ShearModulus => format!("{shown:.1}"),
        }
    }

    /// A number in SI units as text with its unit.
    pub fn quantity(self, si: f64) -> String {
        format!("{}{}", self.number(si), self.spaced_unit())
    }

    /// The unit as it stands behind a number.
    pub fn spaced_unit(self) -> String {
        if self == Self::FrictionAngle { self.unit().to_owned() } else { format!("\u{a0}{}", self.unit()) }
    }

    /// What is known by other means, as text with its unit.
    pub fn knowledge(self, known: Knowledge) -> String {
        let unit = self.spaced_unit();
        match known {
            Knowledge::Value { value, std } if std > 0.0 => {
                format!("{} ± {}{unit}", self.number(value), self.number(std))
            }
            Knowledge::Value { value, .. } => self.quantity(value),
            Knowledge::Between { min, max } => {
                format!("{} to {}{unit}", self.number(min), self.number(max))
            }
        }
    }

    /// An interval as text without its unit.
    pub fn interval(self, [low, high]: [f32; 2]) -> String {
        format!("{} to {}", self.number(low.into()), self.number(high.into()))
    }
}
