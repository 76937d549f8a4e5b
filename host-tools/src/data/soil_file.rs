//! The `[soil]` table of campaigns and soil files.

use std::path::Path;

use kapvik_firmware::terramechanics::Soil;
use serde::Deserialize;
use toml::Spanned;

use super::toml_file::TomlFile;
use crate::error::HostError;

/// What a file says of one parameter.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(untagged, expecting = "expected a number, { value = …, std = … } or { min = …, max = … }")]
pub enum Parameter {
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
    pub n: Option<Spanned<Parameter>>,
    /// Cohesive modulus, Pa/m^(n−1).
    pub k_c: Option<Spanned<Parameter>>,
    /// Frictional modulus, Pa/m^n.
    pub k_phi: Option<Spanned<Parameter>>,
    /// Both moduli in one, k_c / width + k_phi, Pa/m^n; in place of `k_c` and `k_phi`.
    pub k_eff: Option<Spanned<Parameter>>,
    /// Cohesion, Pa.
    pub c: Option<Spanned<Parameter>>,
    /// Friction angle, rad.
    pub phi: Option<Spanned<Parameter>>,
    /// Shear deformation modulus, m.
    #[serde(rename = "K")]
    pub shear_modulus: Option<Spanned<Parameter>>,
    /// Position of the peak stress at zero slip.
    pub c1: Option<Spanned<Parameter>>,
    /// Shift of the peak stress with slip.
    pub c2: Option<Spanned<Parameter>>,
    /// Rebound ratio η; absent = 0.
    pub eta: Option<Spanned<Parameter>>,
}

impl SoilTable {
    /// Reads the soil of a file that has a `[soil]` table or is one, complete enough for the equations.
    ///
    /// # Errors
    /// Where the file cannot be read, a key is unknown, missing, without a value or outside its range.
    pub fn read_complete(path: &Path) -> Result<Soil<f64>, HostError> {
        let file = TomlFile::read(path)?;
        file.section_or_whole::<Self>("soil")?.complete(&file)
    }

    /// The soil of the equations. `eta` is 0 where it is absent, and so is `k_c` beside `k_phi`; all else must be there.
    ///
    /// # Errors
    /// At the key, in `file`.
    pub fn complete(&self, file: &TomlFile) -> Result<Soil<f64>, HostError> {
        let (cohesive_modulus, frictional_modulus) = self.moduli(file)?;
        let soil = Soil {
            sinkage_exponent: required(file, "n", &self.n, at_least_zero)?,
            cohesive_modulus,
            frictional_modulus,
            cohesion_pa: required(file, "c", &self.c, at_least_zero)?,
            friction_angle_rad: required(file, "phi", &self.phi, up_to_a_right_angle)?,
            shear_modulus_m: required(file, "K", &self.shear_modulus, at_least_zero)?,
            peak_stress_c1: required(file, "c1", &self.c1, any_number)?,
            peak_stress_c2: required(file, "c2", &self.c2, any_number)?,
            rebound_ratio: optional(file, "eta", &self.eta, zero_to_one)?.unwrap_or(0.0),
        };
        Ok(soil)
    }

    /// k_c and k_phi, however the file gives them.
    fn moduli(&self, file: &TomlFile) -> Result<(f64, f64), HostError> {
        let k_c = optional(file, "k_c", &self.k_c, any_number)?;
        let k_phi = optional(file, "k_phi", &self.k_phi, any_number)?;
        match (optional(file, "k_eff", &self.k_eff, any_number)?, k_phi) {
            (Some(k_eff), None) if k_c.is_none() => Ok((0.0, k_eff)),
            (Some(_), _) => {
                let place = self.k_eff.as_ref().map_or(0, |k_eff| k_eff.span().start);
                Err(file
                    .error_at_offset(place, "k_eff stands beside k_c or k_phi: expected k_eff alone, or k_c and k_phi"))
            }
            (None, Some(k_phi)) => Ok((k_c.unwrap_or(0.0), k_phi)),
            (None, None) => Err(file.error_at_start("k_phi is missing: expected k_phi (with k_c) in Pa/m^n, or k_eff")),
        }
    }
}

/// Says what a number should have been, if it is not that.
type Range = fn(f64) -> Result<(), &'static str>;

fn any_number(_: f64) -> Result<(), &'static str> {
    Ok(())
}

fn at_least_zero(value: f64) -> Result<(), &'static str> {
    if value >= 0.0 { Ok(()) } else { Err("a number of 0 or more") }
}

fn zero_to_one(value: f64) -> Result<(), &'static str> {
    if (0.0..=1.0).contains(&value) { Ok(()) } else { Err("a number from 0 to 1") }
}

fn up_to_a_right_angle(value: f64) -> Result<(), &'static str> {
    if (0.0..std::f64::consts::FRAC_PI_2).contains(&value) {
        Ok(())
    } else {
        Err("an angle in rad, from 0 to below π/2")
    }
}

fn required(
    file: &TomlFile,
    name: &str,
    parameter: &Option<Spanned<Parameter>>,
    range: Range,
) -> Result<f64, HostError> {
    optional(file, name, parameter, range)?
        .ok_or_else(|| file.error_at_start(format!("{name} is missing: the equations need it")))
}

fn optional(
    file: &TomlFile,
    name: &str,
    parameter: &Option<Spanned<Parameter>>,
    range: Range,
) -> Result<Option<f64>, HostError> {
    let Some(parameter) = parameter else { return Ok(None) };
    let refuse =
        |found: String, expected| Err(file.error_at(parameter, format!("{name} = {found}: expected {expected}")));
    match *parameter.get_ref() {
        Parameter::Exact(value) | Parameter::Known(Known { value, .. }) if value.is_finite() => match range(value) {
            Ok(()) => Ok(Some(value)),
            Err(expected) => refuse(value.to_string(), expected),
        },
        Parameter::Exact(value) | Parameter::Known(Known { value, .. }) => refuse(value.to_string(), "a finite number"),
        Parameter::Free(Bounds { min, max }) => {
            refuse(format!("{min} … {max}"), "one value, as the equations need one")
        }
    }
}
