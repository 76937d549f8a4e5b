//! The `[soil]` table of campaigns and soil files.

use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use kapvik_firmware::terramechanics::Soil;
use serde::Deserialize;
use toml::Spanned;

use super::toml_file::TomlFile;
use crate::digits::significant;
use crate::error::HostError;

/// What a file says of one parameter.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(untagged, expecting = "expected a number, { value = …, std = … } or { min = …, max = … }")]
pub enum StatedNumber {
    /// A number, held to be exact.
    Exact(f64),
    /// Known to one standard deviation.
    Known(Known),
    /// Free between two bounds.
    Free(Bounds),
}

/// A value with its standard deviation.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Known {
    /// The value.
    pub value: f64,
    /// One standard deviation; absent = held to be exact.
    #[serde(default)]
    pub std: f64,
}

/// Two bounds.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bounds {
    /// The lower one.
    pub min: f64,
    /// The upper one.
    pub max: f64,
}

/// A soil as a file describes it: every key may be absent.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SoilTable {
    /// Sinkage exponent n.
    pub n: Option<Spanned<StatedNumber>>,
    /// Cohesive modulus, Pa/m^(n−1).
    pub k_c: Option<Spanned<StatedNumber>>,
    /// Frictional modulus, Pa/m^n.
    pub k_phi: Option<Spanned<StatedNumber>>,
    /// Both moduli in one, k_c / width + k_phi, Pa/m^n; in place of `k_c` and `k_phi`.
    pub k_eff: Option<Spanned<StatedNumber>>,
    /// Cohesion, Pa.
    pub c: Option<Spanned<StatedNumber>>,
    /// Friction angle, rad.
    pub phi: Option<Spanned<StatedNumber>>,
    /// Shear deformation modulus, m.
    #[serde(rename = "K")]
    pub shear_modulus: Option<Spanned<StatedNumber>>,
    /// Position of the peak stress at zero slip.
    pub c1: Option<Spanned<StatedNumber>>,
    /// Shift of the peak stress with slip.
    pub c2: Option<Spanned<StatedNumber>>,
    /// Rebound ratio η; absent = 0.
    pub eta: Option<Spanned<StatedNumber>>,
}

impl SoilTable {
    /// Reads the soil of a file that has a `[soil]` table or is one, complete enough for the equations.
    ///
    /// # Errors
    /// Where the file cannot be read, a key is unknown, missing, without a value or outside its range.
    pub fn read_complete(path: &Path) -> Result<Soil<f64>, HostError> {
        let file = TomlFile::read(path)?;
        Self::complete(&file.section_or_whole("soil")?, &file)
    }

    /// The soil of the equations. `eta` is 0 where it is absent, and so is `k_c` beside `k_phi`; all else must be there.
    ///
    /// # Errors
    /// At the key, in `file`; where one is missing, at the table.
    fn complete(table: &Spanned<Self>, file: &TomlFile) -> Result<Soil<f64>, HostError> {
        let soil = table.get_ref();
        let required = |name: &str, parameter: &Option<Spanned<StatedNumber>>| {
            let missing = || file.error_at(table, format!("{name} is missing: the equations need it"));
            optional(file, name, parameter)?.ok_or_else(missing)
        };
        let (cohesive_modulus, frictional_modulus) = Self::moduli(table, file)?;
        Ok(Soil {
            sinkage_exponent: required("n", &soil.n)?,
            cohesive_modulus,
            frictional_modulus,
            cohesion_pa: required("c", &soil.c)?,
            friction_angle_rad: required("phi", &soil.phi)?,
            shear_modulus_m: required("K", &soil.shear_modulus)?,
            peak_stress_c1: required("c1", &soil.c1)?,
            peak_stress_c2: required("c2", &soil.c2)?,
            rebound_ratio: optional(file, "eta", &soil.eta)?.unwrap_or(0.0),
        })
    }

    /// Refuses a stiffness that stands twice.
    ///
    /// # Errors
    /// At `k_eff`, in `file`.
    pub fn check_stiffness(&self, file: &TomlFile) -> Result<(), HostError> {
        match &self.k_eff {
            Some(k_eff) if self.k_c.is_some() || self.k_phi.is_some() => {
                Err(file.error_at(k_eff, "k_eff beside k_c or k_phi: expected k_eff alone, or k_c and k_phi"))
            }
            _ => Ok(()),
        }
    }

    /// k_c and k_phi, however the file gives them.
    fn moduli(table: &Spanned<Self>, file: &TomlFile) -> Result<(f64, f64), HostError> {
        let soil = table.get_ref();
        soil.check_stiffness(file)?;
        let k_c = optional(file, "k_c", &soil.k_c)?;
        let k_phi = optional(file, "k_phi", &soil.k_phi)?;
        match (optional(file, "k_eff", &soil.k_eff)?, k_phi) {
            (Some(k_eff), _) => Ok((0.0, k_eff)),
            (None, Some(k_phi)) => Ok((k_c.unwrap_or(0.0), k_phi)),
            (None, None) => {
                Err(file.error_at(table, "k_phi is missing: expected k_phi (with k_c) in Pa/m^n, or k_eff"))
            }
        }
    }
}

/// What a parameter of a soil can be.
#[derive(Debug, Clone, Copy)]
pub struct SoilRange {
    /// The least value.
    pub least: f64,
    /// The greatest value.
    pub greatest: f64,
}

impl SoilRange {
    /// That of a key of `[soil]`: beyond it a file is in other units, or of the wrong sign.
    pub fn of(key: &str) -> Self {
        let (least, greatest) = match key {
            "n" => (0.0, 5.0),
            "phi" => (0.0, FRAC_PI_2.next_down()),
            "K" | "eta" => (0.0, 1.0),
            "c1" | "c2" => (-2.0, 2.0),
            "k_c" => (f64::NEG_INFINITY, f64::INFINITY),
            _ => (0.0, f64::INFINITY),
        };
        Self { least, greatest }
    }

    /// What was expected, if a value is not that.
    pub fn check(self, value: f64) -> Result<(), String> {
        let Self { least, greatest } = self;
        if value.is_finite() && (least..=greatest).contains(&value) {
            return Ok(());
        }
        Err(if least == f64::NEG_INFINITY || !value.is_finite() {
            "a finite number".to_owned()
        } else if greatest.is_finite() {
            format!("a number from {least} to {}", significant(greatest, 5))
        } else {
            format!("a number of {least} or more")
        })
    }
}

fn optional(file: &TomlFile, name: &str, parameter: &Option<Spanned<StatedNumber>>) -> Result<Option<f64>, HostError> {
    let Some(parameter) = parameter else { return Ok(None) };
    let refuse =
        |found: String, expected: &str| Err(file.error_at(parameter, format!("{name} = {found}: expected {expected}")));
    match *parameter.get_ref() {
        StatedNumber::Exact(value) | StatedNumber::Known(Known { value, .. }) => match SoilRange::of(name).check(value)
        {
            Ok(()) => Ok(Some(value)),
            Err(expected) => refuse(value.to_string(), &expected),
        },
        StatedNumber::Free(Bounds { min, max }) => {
            refuse(format!("{min} … {max}"), "one value, as the equations need one")
        }
    }
}
