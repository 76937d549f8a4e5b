//! `[declared]`: the effects that the model is told of.

use std::collections::BTreeMap;
use std::fmt;

use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use toml::Spanned;

use crate::error::HostError;

use super::super::toml_file::TomlFile;

/// The ids of all effects that the seed's equations lack.
pub const EFFECT_IDS: [&str; 22] = [
    "slip-sinkage",
    "grouser-thrust",
    "grouser-ripple",
    "multi-pass",
    "lateral-slip",
    "bulldozing",
    "interface-friction",
    "shear-hump",
    "rear-contact",
    "peak-stress-shift",
    "load-stiffening",
    "sinkage-lag",
    "rate",
    "drive-friction",
    "torque-scale",
    "force-bias",
    "force-drift",
    "crosstalk",
    "guide-friction",
    "rolling-radius",
    "pitch-misalignment",
    "sinkage-reference",
];

/// What stands in `[declared]`: `effects = […]`, and a table of parameters for an effect.
#[derive(Debug, Default)]
pub(super) struct DeclaredTable {
    effects: Vec<Spanned<String>>,
    parameters: Vec<(Spanned<String>, BTreeMap<String, f64>)>,
}

/// The effects that the model is told of, in the order of the file; none is the seed's equations 1–11 exactly.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Declared {
    /// Each effect's id, and those of its parameters that are given.
    pub effects: Vec<(String, BTreeMap<String, f64>)>,
}

impl Declared {
    /// # Errors
    /// At an id that there is not, or parameters of an effect that is not in the list.
    pub(super) fn read(table: DeclaredTable, file: &TomlFile) -> Result<Self, HostError> {
        let mut declared = Self::default();
        for id in table.effects {
            check_id(&id, file)?;
            declared.effects.push((id.into_inner(), BTreeMap::new()));
        }
        for (id, given) in table.parameters {
            check_id(&id, file)?;
            let Some((_, parameters)) = declared.effects.iter_mut().find(|(name, _)| name == id.get_ref()) else {
                let message = format!("parameters of {}, which `effects` does not list", id.get_ref());
                return Err(file.error_at(&id, message));
            };
            *parameters = given;
        }
        Ok(declared)
    }

    /// The ids alone.
    pub fn ids(&self) -> Vec<String> {
        self.effects.iter().map(|(id, _)| id.clone()).collect()
    }
}

fn check_id(id: &Spanned<String>, file: &TomlFile) -> Result<(), HostError> {
    if EFFECT_IDS.contains(&id.get_ref().as_str()) {
        return Ok(());
    }
    Err(file.error_at(id, format!("no effect `{}`: expected one of {}", id.get_ref(), EFFECT_IDS.join(", "))))
}

impl<'de> Deserialize<'de> for DeclaredTable {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(TableVisitor)
    }
}

/// By hand, because what a value must be depends on its key.
struct TableVisitor;

impl<'de> Visitor<'de> for TableVisitor {
    type Value = DeclaredTable;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a table with `effects = […]`, and a table of parameters for an effect")
    }

    fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<DeclaredTable, M::Error> {
        let mut table = DeclaredTable::default();
        while let Some(key) = map.next_key::<Spanned<String>>()? {
            if key.get_ref() == "effects" {
                table.effects = map.next_value()?;
            } else {
                table.parameters.push((key, map.next_value()?));
            }
        }
        Ok(table)
    }
}
