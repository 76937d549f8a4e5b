//! `NAME.toml` as it is written.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};
use serde_aux::serde_introspection::serde_introspect;
use toml::Spanned;

use crate::error::HostError;

use super::super::rover_fault::STRONGEST_M_S2;
use super::super::soil_file::SoilTable;
use super::super::toml_file::{TomlFile, UnusedKeys};
use super::super::wheel_file::WheelTable;
use super::declared::DeclaredTable;

/// Where the numbers of a campaign come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Provenance {
    /// By instruments; the numbers are theirs.
    Measured,
    /// Measured by others, and read off their published curves.
    Digitised,
    /// Computed.
    Simulated,
}

impl fmt::Display for Provenance {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Measured => "measured",
            Self::Digitised => "digitised",
            Self::Simulated => "simulated",
        })
    }
}

/// What the file says besides.
#[derive(Debug, Deserialize)]
#[serde(untagged, expecting = "expected a text or a list of texts")]
pub(super) enum Notes {
    One(String),
    Several(Vec<String>),
}

impl Default for Notes {
    fn default() -> Self {
        Self::Several(Vec::new())
    }
}

impl From<Notes> for Vec<String> {
    fn from(notes: Notes) -> Self {
        match notes {
            Notes::One(note) => vec![note],
            Notes::Several(notes) => notes,
        }
    }
}

/// The file, table by table.
#[derive(Debug, Deserialize)]
pub(super) struct About {
    pub name: String,
    pub kind: Provenance,
    #[serde(default)]
    pub source: String,
    #[serde(default)]
    pub notes: Notes,
    #[serde(default = "standard_gravity")]
    pub gravity_m_s2: Spanned<f64>,
    pub wheel: WheelTable,
    #[serde(default)]
    pub soil: SoilTable,
    #[serde(default)]
    pub noise: BTreeMap<Spanned<String>, Spanned<f64>>,
    #[serde(default)]
    pub declared: DeclaredTable,
}

fn standard_gravity() -> Spanned<f64> {
    Spanned::new(0..0, 9.81)
}

impl About {
    /// The file, and what of it is not used.
    pub fn read(file: &TomlFile) -> Result<(Self, UnusedKeys), HostError> {
        let (about, unused): (Self, _) =
            file.whole_and_more(&[serde_introspect::<WheelTable>(), serde_introspect::<SoilTable>()])?;
        about.wheel.check(file)?;
        let gravity = *about.gravity_m_s2.get_ref();
        if !(gravity > 0.0 && gravity <= STRONGEST_M_S2) {
            let message = format!("gravity_m_s2 = {gravity}: expected a number above 0 m/s², at most {STRONGEST_M_S2}");
            return Err(file.error_at(&about.gravity_m_s2, message));
        }
        Ok((about, unused))
    }
}
