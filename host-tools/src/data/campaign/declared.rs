//! `[declared]`: the effects that the model is told of.

use std::collections::BTreeMap;

use serde::Deserialize;
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
pub(super) type DeclaredTable = BTreeMap<Spanned<String>, Spanned<Entry>>;

#[derive(Debug, Deserialize)]
#[serde(untagged, expecting = "expected a list of effects, or a table of an effect's parameters")]
pub(super) enum Entry {
    Effects(Vec<Spanned<String>>),
    Parameters(BTreeMap<String, f64>),
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
    pub(super) fn read(mut table: DeclaredTable, file: &TomlFile) -> Result<Self, HostError> {
        let list = table.iter().find(|(key, _)| key.get_ref() == "effects").map(|(key, _)| key.clone());
        let mut declared = Self::default();
        if let Some(entry) = list.and_then(|key| table.remove(&key)) {
            let Entry::Effects(ids) = entry.get_ref() else {
                return Err(file.error_at(&entry, "effects: expected a list, [] for the seed's equations"));
            };
            for id in ids {
                check_id(id, file)?;
                declared.effects.push((id.get_ref().clone(), BTreeMap::new()));
            }
        }
        for (id, entry) in table {
            check_id(&id, file)?;
            let effect = declared.effects.iter_mut().find(|(name, _)| name == id.get_ref());
            match (effect, entry.into_inner()) {
                (Some((_, parameters)), Entry::Parameters(given)) => *parameters = given,
                (Some(_), Entry::Effects(_)) => {
                    return Err(file.error_at(&id, "expected a table of the effect's parameters"));
                }
                (None, _) => {
                    let message = format!("parameters of {}, which `effects` does not list", id.get_ref());
                    return Err(file.error_at(&id, message));
                }
            }
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
