//! `[declared]`: the effects that the model is told of.

use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;

use kapvik_firmware::terramechanics::effects::{CATALOGUE, EffectInfo, Form, effect_info};
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use toml::Spanned;

use crate::error::HostError;

use super::super::soil_file::{SoilRange, StatedNumber};
use super::super::text::TextFile;
use super::super::toml_file::TomlFile;
use super::ground::{Knowledge, knowledge};

/// What stands in `[declared]`: `effects = […]`, and a table of parameters for an effect.
#[derive(Debug, Default)]
pub(super) struct DeclaredTable {
    effects: Vec<Spanned<String>>,
    parameters: Vec<(Spanned<String>, Entries)>,
}

/// A file that holds the table, whatever else.
#[derive(Deserialize)]
struct Holder {
    declared: Option<DeclaredTable>,
}

/// What the names of parameters begin with whose change only moves another parameter: the load, the speed or the temperature at which that
/// one does nothing.
const REFERENCE: &str = "reference";

/// The table of an effect.
type Entries = BTreeMap<Spanned<String>, Spanned<Entry>>;

/// An entry of an effect's table: the form it has, or what is known of a parameter.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged, expecting = "expected a number, { value = …, std = … }, { min = …, max = … } or the name of a form")]
enum Entry {
    Parameter(StatedNumber),
    Form(String),
}

/// The effects that the model is told of, in the order of the file; none is the seed's equations 1–11 exactly.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Declared {
    /// The effects.
    pub effects: Vec<DeclaredEffect>,
}

/// An effect that the model is told of.
#[derive(Debug, Clone, PartialEq)]
pub struct DeclaredEffect {
    /// Which one.
    pub info: &'static EffectInfo,
    /// The form in which it comes, where the file says so.
    pub form: Option<&'static Form>,
    /// What is known of its parameters, by name.
    pub known: BTreeMap<&'static str, Knowledge>,
}

impl DeclaredEffect {
    /// Whether it may have a form: what is known of it are parameters that the form frees or sets, or what these refer to.
    pub fn may_be(&self, form: &Form) -> bool {
        self.known.keys().all(|name| may_have(form, name))
    }

    /// Checks that what is known of it are parameters of the form that the file states: another form's would change the law all the same.
    fn check_form(&self, entries: &Entries, file: &TomlFile) -> Result<(), HostError> {
        let Some(form) = self.form.filter(|form| !self.may_be(form)) else { return Ok(()) };
        let is_other = |name: &&Spanned<String>| *name.get_ref() != "form" && !may_have(form, name.get_ref());
        let Some(name) = entries.keys().find(is_other) else { return Ok(()) };
        let names = self.info.parameters.iter().map(|parameter| parameter.name);
        let its_own: Vec<_> = names.filter(|name| form.has(name)).collect();
        let message =
            format!("{} is no parameter of the form {}: expected {}", name.get_ref(), form.name, its_own.join(", "));
        Err(file.error_at(name, message))
    }

    /// The forms that it may have; none where the file states it.
    pub fn open_forms(&self) -> impl Iterator<Item = &'static Form> + use<'_> {
        self.info.forms.iter().filter(|form| self.form.is_none() && self.may_be(form))
    }

    /// The same in one form, as if the file stated it.
    #[must_use]
    pub fn in_form(&self, form: &'static Form) -> Self {
        Self { form: Some(form), ..self.clone() }
    }

    /// The form that the file states, else the first that it may have, else the effect's first.
    pub fn first_form(&self) -> Option<&'static Form> {
        let may_be = || self.info.forms.iter().find(|form| self.may_be(form));
        self.form.or_else(may_be).or(self.info.forms.first())
    }
}

/// Whether something may be known of a parameter beside a form: one that it frees or sets, or what these refer to.
fn may_have(form: &Form, parameter: &str) -> bool {
    form.has(parameter) || is_reference(parameter)
}

/// Whether a parameter is what others refer to: the load, speed or temperature at which an effect does nothing.
pub fn is_reference(parameter: &str) -> bool {
    parameter.starts_with(REFERENCE)
}

impl Declared {
    /// # Errors
    /// At an id, a form or a parameter that there is not, an id that stands twice, or parameters of an effect that is not in the list.
    pub(super) fn read(table: DeclaredTable, file: &TomlFile) -> Result<Self, HostError> {
        let mut declared = Self::default();
        for id in table.effects {
            let info = effect(&id, file)?;
            if declared.effects.iter().any(|listed| listed.info.id == info.id) {
                let message = format!("{} for the second time: expected each effect once in `effects`", info.id);
                return Err(file.error_at(&id, message));
            }
            declared.effects.push(DeclaredEffect { info, form: None, known: BTreeMap::new() });
        }
        for (id, entries) in table.parameters {
            let info = effect(&id, file)?;
            let Some(place) = declared.effects.iter_mut().find(|effect| effect.info.id == info.id) else {
                let message = format!("parameters of {}, which `effects` does not list", info.id);
                return Err(file.error_at(&id, message));
            };
            for (name, entry) in &entries {
                match entry.get_ref() {
                    Entry::Form(form) => place.form = Some(find_form(info, form, name, entry, file)?),
                    Entry::Parameter(known) => {
                        let (name, known) = parameter(info, name, *known, entry, file)?;
                        place.known.insert(name, known);
                    }
                }
            }
            place.check_form(&entries, file)?;
        }
        Ok(declared)
    }

    /// The table `[declared]` of a file, whatever else it holds.
    ///
    /// # Errors
    /// Where the file cannot be read or has no such table, and as for a campaign's.
    pub fn read_from(path: &Path) -> Result<Self, HostError> {
        Self::of_file(&TomlFile::read(path)?)
    }

    /// [`Self::read_from`] of a text, under the name `path`.
    ///
    /// # Errors
    /// As [`Self::read_from`].
    pub fn parse(path: &Path, text: &str) -> Result<Self, HostError> {
        Self::of_file(&TomlFile::new(TextFile::new(path, text)))
    }

    fn of_file(file: &TomlFile) -> Result<Self, HostError> {
        let Holder { declared } = file.whole()?;
        let table =
            declared.ok_or_else(|| file.error_at_start("no table [declared]: expected one with `effects = […]`"))?;
        Self::read(table, file)
    }

    /// The ids alone.
    pub fn ids(&self) -> Vec<String> {
        self.effects.iter().map(|effect| effect.info.id.to_owned()).collect()
    }
}

fn effect(id: &Spanned<String>, file: &TomlFile) -> Result<&'static EffectInfo, HostError> {
    effect_info(id.get_ref()).ok_or_else(|| {
        let ids: Vec<_> = CATALOGUE.iter().map(|effect| effect.id).collect();
        file.error_at(id, format!("no effect `{}`: expected one of {}", id.get_ref(), ids.join(", ")))
    })
}

fn find_form(
    info: &'static EffectInfo,
    form: &str,
    key: &Spanned<String>,
    entry: &Spanned<Entry>,
    file: &TomlFile,
) -> Result<&'static Form, HostError> {
    if key.get_ref() != "form" {
        let message = format!("{}: a text: expected a number, {{ value, std }} or {{ min, max }}", key.get_ref());
        return Err(file.error_at(entry, message));
    }
    let names: Vec<_> = info.forms.iter().map(|form| form.name).collect();
    let found = info.forms.iter().find(|known| known.name == form);
    found.ok_or_else(|| {
        let message = format!("no form `{form}` of {}: expected one of {}", info.id, names.join(" | "));
        file.error_at(entry, message)
    })
}

fn parameter(
    info: &'static EffectInfo,
    name: &Spanned<String>,
    known: StatedNumber,
    entry: &Spanned<Entry>,
    file: &TomlFile,
) -> Result<(&'static str, Knowledge), HostError> {
    let Some(parameter) = info.parameter(name.get_ref()) else {
        let names: Vec<_> = info.parameters.iter().map(|parameter| parameter.name).collect();
        let message = format!("no parameter `{}` of {}: expected {}", name.get_ref(), info.id, names.join(", "));
        return Err(file.error_at(name, message));
    };
    let known = knowledge(
        file,
        parameter.name,
        &Spanned::new(entry.span(), known),
        SoilRange { least: parameter.low, greatest: parameter.high },
    )?;
    Ok((parameter.name, known))
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
                let entries = map.next_value().map_err(|error: M::Error| unlike_a_table(key.get_ref(), error))?;
                table.parameters.push((key, entries));
            }
        }
        Ok(table)
    }
}

/// Of a key that holds no table: a misspelt `effects`, or no effect's id.
fn unlike_a_table<E: serde::de::Error>(key: &str, error: E) -> E {
    let is_an_effect = effect_info(key).is_some();
    if is_an_effect {
        error
    } else {
        E::custom(format!("`{key}`: expected `effects`, or the table of an effect: {error}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_known_of_an_effect_says_which_form_it_has() {
        let form = |parameters: &str| {
            let text = format!("[declared]\neffects = [\"slip-sinkage\"]\n[declared.slip-sinkage]\n{parameters}");
            let declared = Declared::parse(Path::new("declared.toml"), &text).expect("declared");
            declared.effects[0].first_form().map(|form| form.name)
        };
        assert_eq!(form("n1 = 0.3\n"), Some("exponent"));
        assert_ne!(form("stretch = 0.4\n"), Some("exponent"), "which has no such parameter");
        assert_eq!(form("form = \"exponent\"\nn1 = 0.3\n"), Some("exponent"));
    }

    #[test]
    fn a_parameter_of_another_form_than_the_one_stated_is_an_error_at_its_place() {
        let text =
            "[declared]\neffects = [\"slip-sinkage\"]\n[declared.slip-sinkage]\nform = \"exponent\"\nstretch = 0.4\n";
        let error = Declared::parse(Path::new("declared.toml"), text).expect_err("two forms").to_string();
        assert!(error.starts_with("declared.toml:5:1: stretch is no parameter of the form exponent"), "{error}");
        assert!(error.contains("expected n1"), "{error}");
    }

    #[test]
    fn an_effect_that_stands_twice_is_an_error_at_its_second_place() {
        let text = "[declared]\neffects = [\"rate\", \"force-bias\", \"rate\"]\n[declared.rate]\nstiffness = 0.1\n";
        let error = Declared::parse(Path::new("declared.toml"), text).expect_err("twice").to_string();
        assert!(
            error.contains("declared.toml:2:34") && error.contains("rate") && error.contains("expected"),
            "{error}"
        );
    }
}
