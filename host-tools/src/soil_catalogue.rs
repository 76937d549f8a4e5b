//! Soils of the literature, each with its source and with what the source leaves open.

use std::fmt;

use kapvik_firmware::terramechanics::Soil;
use serde::Deserialize;

use crate::error::HostError;

/// The catalogue as it stands in `data/soils.toml`.
const CATALOGUE: &str = include_str!("../data/soils.toml");

/// One pound per square inch, Pa.
const PSI: f64 = 6_894.757_293_168;
/// One inch, m.
const INCH: f64 = 0.0254;

/// The seed's Table 1, which the catalogue holds too.
pub const TABLE_1: Soil<f64> = Soil {
    sinkage_exponent: 1.1,
    cohesive_modulus: 15_600.0,
    frictional_modulus: 2_407_400.0,
    cohesion_pa: 250.0,
    friction_angle_rad: 0.556_760_031_386_191_1,
    shear_modulus_m: 0.0114,
    peak_stress_c1: 0.18,
    peak_stress_c2: 0.32,
    rebound_ratio: 0.0,
};

/// A soil as its source gives it, in the units of the literature; what the source does not give is absent.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CatalogueSoil {
    /// Short name, unique in the catalogue.
    pub id: String,
    /// Name in words.
    pub name: String,
    /// Where the figures come from.
    pub source: String,
    /// Sinkage exponent.
    pub n: Option<f64>,
    /// Cohesive modulus, kPa/m^(n−1).
    pub k_c_kpa: Option<f64>,
    /// Frictional modulus, kPa/m^n.
    pub k_phi_kpa: Option<f64>,
    /// Pressure in Reece's form, for a known wheel.
    pub reece_wheel: Option<ReeceWheel>,
    /// Pressure in Reece's form, for any wheel.
    pub reece: Option<Reece>,
    /// Cohesion, kPa.
    pub c_kpa: Option<Figure>,
    /// Friction angle, degrees.
    pub phi_deg: Option<Figure>,
    /// Shear deformation modulus, mm.
    #[serde(rename = "K_mm")]
    pub shear_modulus_mm: Option<Figure>,
    /// Position of the peak stress at zero slip.
    pub c1: Option<Figure>,
    /// Shift of the peak stress with slip.
    pub c2: Option<Figure>,
    /// Rebound ratio.
    pub eta: Option<f64>,
    /// Keys (n, k_c, k_phi, c, phi, K, c1, c2, eta) that the source took over or guessed.
    #[serde(default)]
    pub assumed: Vec<String>,
    /// What else is known.
    pub note: Option<String>,
}

/// A figure of the literature: one value, a range, or both.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum Figure {
    /// One value.
    Value(f64),
    /// A range, perhaps with the value that the source prefers.
    Range {
        /// The preferred value.
        value: Option<f64>,
        /// Lower end.
        min: f64,
        /// Upper end.
        max: f64,
    },
}

/// Reece's pressure p = (k₁ + k₂ b)(z/b)ⁿ, in pounds and inches, and the width it was used with.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReeceWheel {
    /// k₁, lb/in².
    pub k1_psi: f64,
    /// k₂, lb/in³.
    pub k2_psi_in: f64,
    /// Width of the wheel b, m.
    pub width_m: f64,
}

/// Reece's pressure p = (c k'_c + γ b k'_φ)(z/b)ⁿ with dimensionless moduli.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reece {
    /// k'_c.
    pub k_c: f64,
    /// k'_φ.
    pub k_phi: f64,
    /// Density, kg/m³.
    pub density_kg_m3: f64,
}

/// What stands in for the parameters that a source leaves open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Completion {
    /// K, m.
    pub shear_modulus_m: f64,
    /// c₁.
    pub peak_stress_c1: f64,
    /// c₂.
    pub peak_stress_c2: f64,
    /// η.
    pub rebound_ratio: f64,
}

/// Why a soil cannot be completed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Incomplete {
    /// Nothing says how it carries: n, or both moduli, are not known.
    Pressure,
    /// Reece's moduli without the width that they would have to be converted for.
    ReeceWithoutWidth,
    /// Cohesion or friction angle is not known.
    Strength,
}

impl fmt::Display for Incomplete {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Pressure => "n or its moduli",
            Self::ReeceWithoutWidth => "the width of the wheel that its moduli are for",
            Self::Strength => "cohesion or friction angle",
        })
    }
}

impl Completion {
    /// The seed's Table 1: K = 11.4 mm, c₁ = 0.18, c₂ = 0.32; no rebound.
    pub const SEED: Self = Self {
        shear_modulus_m: TABLE_1.shear_modulus_m,
        peak_stress_c1: TABLE_1.peak_stress_c1,
        peak_stress_c2: TABLE_1.peak_stress_c2,
        rebound_ratio: TABLE_1.rebound_ratio,
    };
}

impl Figure {
    /// The value, or the middle of the range.
    pub fn value(self) -> f64 {
        match self {
            Self::Value(value) | Self::Range { value: Some(value), .. } => value,
            Self::Range { value: None, min, max } => 0.5 * (min + max),
        }
    }
}

impl fmt::Display for Figure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Value(value) => write!(f, "{value}"),
            Self::Range { value: Some(value), min, max } => write!(f, "{value} ({min}–{max})"),
            Self::Range { value: None, min, max } => write!(f, "{min}–{max}"),
        }
    }
}

impl CatalogueSoil {
    /// A soil for the equations: ranges become their middle, and what is absent is taken from `completion` (K, c₁, c₂, η
    /// alone; nothing stands in for a pressure law or a strength that is not known).
    ///
    /// Reece's k₁ and k₂ become k_c = k₁ b^(1−n) and k_φ = k₂ b^(1−n), which is the same pressure under a wheel of the
    /// width b that they were used with, and an extrapolation under another.
    ///
    /// # Errors
    /// Says what is missing.
    pub fn complete(&self, completion: &Completion) -> Result<Soil<f64>, Incomplete> {
        let (cohesive_modulus, frictional_modulus) = self.moduli()?;
        let value = |figure: Option<Figure>, other: f64| figure.map_or(other, Figure::value);
        Ok(Soil {
            sinkage_exponent: self.n.ok_or(Incomplete::Pressure)?,
            cohesive_modulus,
            frictional_modulus,
            cohesion_pa: 1e3 * self.c_kpa.ok_or(Incomplete::Strength)?.value(),
            friction_angle_rad: self.phi_deg.ok_or(Incomplete::Strength)?.value().to_radians(),
            shear_modulus_m: self.shear_modulus_mm.map_or(completion.shear_modulus_m, |k| 1e-3 * k.value()),
            peak_stress_c1: value(self.c1, completion.peak_stress_c1),
            peak_stress_c2: value(self.c2, completion.peak_stress_c2),
            rebound_ratio: self.eta.unwrap_or(completion.rebound_ratio),
        })
    }

    /// k_c in Pa/m^(n−1) and k_φ in Pa/m^n.
    fn moduli(&self) -> Result<(f64, f64), Incomplete> {
        let n = self.n.ok_or(Incomplete::Pressure)?;
        match (self.k_phi_kpa, self.reece_wheel, self.reece) {
            (Some(k_phi), _, _) => Ok((1e3 * self.k_c_kpa.unwrap_or(0.0), 1e3 * k_phi)),
            (None, Some(reece), _) => {
                let scale = reece.width_m.powf(1.0 - n);
                Ok((reece.k1_psi * PSI * scale, reece.k2_psi_in * PSI / INCH * scale))
            }
            (None, None, Some(_)) => Err(Incomplete::ReeceWithoutWidth),
            (None, None, None) => Err(Incomplete::Pressure),
        }
    }
}

/// Every soil of the catalogue.
///
/// # Errors
/// Where the data file that is built in is not what it should be; a test holds that it is.
pub fn catalogue() -> Result<Vec<CatalogueSoil>, HostError> {
    #[derive(Deserialize)]
    struct File {
        soil: Vec<CatalogueSoil>,
    }
    let file = toml::from_str::<File>(CATALOGUE);
    file.map(|file| file.soil).map_err(|error| HostError::Failed(format!("the catalogue of soils: {error}")))
}
