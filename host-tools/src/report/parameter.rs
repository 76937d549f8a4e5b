//! The three parameters of the soil in a report: what is known of them, and how they are written and drawn.

use kapvik_firmware::soil::{ParameterEstimate, SoilEstimate};

use crate::data::campaign::{Ground, Knowledge};
use crate::parameter::Parameter;
use crate::prior::{self, Range};

use super::draw::{Pixels, Scale};

impl Parameter {
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
