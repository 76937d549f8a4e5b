//! `[soil]`: what is known of the soil by other means than the wheel.

use std::cmp::Ordering;

use kapvik_firmware::terramechanics::{Soil, Wheel};
use toml::Spanned;

use crate::error::HostError;
use crate::prior::{self, Range};

use super::super::soil_file::{Bounds, Known, SoilRange, SoilTable, StatedNumber};
use super::super::toml_file::TomlFile;

/// What is known of one parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Knowledge {
    /// A value, with one standard deviation (0: held to be exact).
    Value {
        /// The value.
        value: f64,
        /// One standard deviation.
        std: f64,
    },
    /// Free between two bounds.
    Between {
        /// The lower one.
        min: f64,
        /// The upper one.
        max: f64,
    },
}

impl Knowledge {
    /// The value, or the middle between the bounds.
    pub fn middle(self) -> f64 {
        match self {
            Self::Value { value, .. } => value,
            Self::Between { min, max } => 0.5 * (min + max),
        }
    }

    /// One standard deviation; between bounds that of an even distribution.
    pub fn std(self) -> f64 {
        match self {
            Self::Value { std, .. } => std,
            Self::Between { min, max } => (max - min) / 12_f64.sqrt(),
        }
    }

    /// What is known of a sum. A standard deviation is no bound: with one, both together are as likely as their middles and variances say.
    fn plus(self, other: Self) -> Self {
        let scatters = |one: Self| matches!(one, Self::Value { std, .. } if std > 0.0);
        let are_values = self.value().is_some() && other.value().is_some();
        if are_values || scatters(self) || scatters(other) {
            return Self::Value { value: self.middle() + other.middle(), std: self.std().hypot(other.std()) };
        }
        let ((low, high), (other_low, other_high)) = (self.range(), other.range());
        Self::Between { min: low + other_low, max: high + other_high }
    }

    /// From one standard deviation below to one above, or the bounds.
    pub fn range(self) -> (f64, f64) {
        self.within(1.0)
    }

    /// From so many standard deviations below to as many above, or the bounds.
    pub fn within(self, stds: f64) -> (f64, f64) {
        match self {
            Self::Value { value, std } => (value - stds * std, value + stds * std),
            Self::Between { min, max } => (min, max),
        }
    }

    /// The value, where there is one.
    pub fn value(self) -> Option<f64> {
        match self {
            Self::Value { value, .. } => Some(value),
            Self::Between { .. } => None,
        }
    }

    fn scaled(self, factor: f64) -> Self {
        match self {
            Self::Value { value, std } => Self::Value { value: factor * value, std: factor * std },
            Self::Between { min, max } => Self::Between { min: factor * min, max: factor * max },
        }
    }
}

/// What is known of the soil by other means. SI units; a parameter that the file does not name is none.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Ground {
    /// Sinkage exponent n.
    pub sinkage_exponent: Option<Knowledge>,
    /// Cohesive modulus k_c, Pa/m^(n−1).
    pub cohesive_modulus: Option<Knowledge>,
    /// Frictional modulus k_φ, Pa/m^n.
    pub frictional_modulus: Option<Knowledge>,
    /// k_c / b + k_φ, Pa/m^n, where it is given in place of the two.
    pub stiffness: Option<Knowledge>,
    /// Cohesion c, Pa.
    pub cohesion_pa: Option<Knowledge>,
    /// Angle of internal friction φ, rad.
    pub friction_angle_rad: Option<Knowledge>,
    /// Shear deformation modulus K, m.
    pub shear_modulus_m: Option<Knowledge>,
    /// Position of the peak stress c₁.
    pub peak_stress_c1: Option<Knowledge>,
    /// Shift of the peak stress c₂.
    pub peak_stress_c2: Option<Knowledge>,
    /// Rebound ratio η; absent means none.
    pub rebound_ratio: Option<Knowledge>,
}

impl Ground {
    /// # Errors
    /// At the parameter that is outside its range or given twice.
    pub(super) fn read(table: &SoilTable, file: &TomlFile) -> Result<Self, HostError> {
        let read = |name, place: &Option<Spanned<StatedNumber>>| {
            place.as_ref().map(|parameter| knowledge(file, name, parameter, SoilRange::of(name))).transpose()
        };
        table.check_stiffness(file)?;
        Ok(Self {
            sinkage_exponent: read("n", &table.n)?,
            cohesive_modulus: read("k_c", &table.k_c)?,
            frictional_modulus: read("k_phi", &table.k_phi)?,
            stiffness: read("k_eff", &table.k_eff)?,
            cohesion_pa: read("c", &table.c)?,
            friction_angle_rad: read("phi", &table.phi)?,
            shear_modulus_m: read("K", &table.shear_modulus)?,
            peak_stress_c1: read("c1", &table.c1)?,
            peak_stress_c2: read("c2", &table.c2)?,
            rebound_ratio: read("eta", &table.eta)?,
        })
    }

    /// What is said where something is known that tells nothing by itself.
    pub(super) fn of_unused(&self) -> Option<String> {
        (self.cohesive_modulus.is_some() && self.frictional_modulus.is_none()).then(|| {
            "k_c alone says nothing of the stiffness k_c/b + k_phi, and is not used: expected k_phi beside it."
                .to_owned()
        })
    }

    /// Stiffness k_c / b + k_φ under a wheel, Pa/m^n, from whichever keys the file has.
    pub fn stiffness(&self, wheel: &Wheel<f64>) -> Option<Knowledge> {
        if self.stiffness.is_some() {
            return self.stiffness;
        }
        let cohesive = self.cohesive_modulus.map(|k_c| k_c.scaled(1.0 / wheel.width_m));
        match (cohesive, self.frictional_modulus?) {
            (None, k_phi) => Some(k_phi),
            (Some(k_c), k_phi) => Some(k_c.plus(k_phi)),
        }
    }

    /// The middle of what is known under a wheel, its stiffness all in k_φ. What nobody knows is the middle of what the networks were trained
    /// with, and a rebound that nobody speaks of none.
    pub fn middle(&self, wheel: &Wheel<f64>) -> Soil<f64> {
        let or_middle = |known: Option<Knowledge>, range: Range| known.map_or_else(|| range.at(0.5), Knowledge::middle);
        Soil {
            sinkage_exponent: or_middle(self.sinkage_exponent, prior::SINKAGE_EXPONENT),
            cohesive_modulus: 0.0,
            frictional_modulus: or_middle(self.stiffness(wheel), prior::STIFFNESS),
            cohesion_pa: or_middle(self.cohesion_pa, prior::COHESION_PA),
            friction_angle_rad: or_middle(self.friction_angle_rad, prior::FRICTION_ANGLE_RAD),
            shear_modulus_m: or_middle(self.shear_modulus_m, prior::SHEAR_MODULUS_M),
            peak_stress_c1: or_middle(self.peak_stress_c1, prior::PEAK_STRESS_C1),
            peak_stress_c2: or_middle(self.peak_stress_c2, prior::PEAK_STRESS_C2),
            rebound_ratio: self.rebound_ratio.map_or(0.0, Knowledge::middle),
        }
    }
}

/// What a file says of a parameter that may lie in a range.
pub(super) fn knowledge(
    file: &TomlFile,
    name: &str,
    parameter: &Spanned<StatedNumber>,
    range: SoilRange,
) -> Result<Knowledge, HostError> {
    let refuse = |what: String| Err(file.error_at(parameter, format!("{name}{what}")));
    let (known, low, high) = match *parameter.get_ref() {
        StatedNumber::Exact(value) => (Knowledge::Value { value, std: 0.0 }, value, value),
        StatedNumber::Known(Known { value, std }) => {
            if !(std >= 0.0 && std.is_finite()) {
                return refuse(format!(": std = {std}: expected a standard deviation of 0 or more"));
            }
            (Knowledge::Value { value, std }, value, value)
        }
        StatedNumber::Free(Bounds { min, max }) => {
            // Also where one of them is not a number.
            if min.partial_cmp(&max) != Some(Ordering::Less) {
                return refuse(format!(": min = {min}, max = {max}: expected min below max"));
            }
            (Knowledge::Between { min, max }, min, max)
        }
    };
    for value in [low, high] {
        if let Err(expected) = range.check(value) {
            return refuse(format!(" = {value}: expected {expected}"));
        }
    }
    Ok(known)
}
