//! TOML files whose problems are told by line and column.

use std::path::Path;

use serde::de::DeserializeOwned;
use serde_aux::serde_introspection::serde_introspect;
use toml::Spanned;
use toml::de::{DeTable, Deserializer, Error, ValueDeserializer};

use super::misspelling::key_meant;
use super::text::TextFile;
use crate::error::HostError;

/// Keys of a file that nobody reads, each with its place.
#[must_use]
#[derive(Debug)]
pub struct UnusedKeys(Vec<HostError>);

impl UnusedKeys {
    /// Tells them on standard error: once the file is known to be good, so that an error stands there alone.
    pub fn tell(&self) {
        self.0.iter().for_each(|key| eprintln!("kapvik: {key}"));
    }
}

/// A TOML file.
#[derive(Debug, Clone)]
pub struct TomlFile {
    file: TextFile,
}

impl TomlFile {
    /// A file whose text is already in memory.
    pub fn new(file: TextFile) -> Self {
        Self { file }
    }

    /// Reads a file; what it says is looked at by [`Self::section_or_whole`] and the like.
    ///
    /// # Errors
    /// Where the file cannot be read or is not UTF-8.
    pub fn read(path: &Path) -> Result<Self, HostError> {
        Ok(Self { file: TextFile::read(path)? })
    }

    /// The whole file as a `T`.
    ///
    /// # Errors
    /// Where the file is not TOML, or not a `T`.
    pub fn whole<T: DeserializeOwned>(&self) -> Result<T, HostError> {
        toml::from_str(self.file.text()).map_err(|error| self.error(&error))
    }

    /// The whole file as a `T`, a struct that lets unknown keys pass; and the keys and tables at its top that `T` has not, which are not used,
    /// for who keeps a file may note more in it than this program reads.
    ///
    /// # Errors
    /// Where the file is not TOML, or not a `T`, or has such a key whose name is nearly one of `T`'s, or of `in_tables`: of what stands in
    /// the tables of a `T`.
    pub fn whole_and_more<T: DeserializeOwned>(
        &self,
        in_tables: &[&'static [&'static str]],
    ) -> Result<(T, UnusedKeys), HostError> {
        let document = DeTable::parse(self.file.text()).map_err(|error| self.error(&error))?;
        let fields = serde_introspect::<T>();
        let further = document.get_ref().keys().filter(|key| !fields.contains(&key.get_ref().as_ref()));
        let further: Vec<_> = further.cloned().collect();
        for key in &further {
            let name = key.get_ref();
            let in_table = || in_tables.iter().find_map(|names| key_meant(name, names));
            let meant = key_meant(name, fields).map(|meant| format!("`{meant}`"));
            if let Some(meant) = meant.or_else(|| in_table().map(|meant| format!("`{meant}` of a table"))) {
                return Err(self.error_at(key, format!("unknown field `{name}`: is {meant} meant?")));
            }
        }
        let whole = T::deserialize(Deserializer::from(document)).map_err(|error| self.error(&error))?;
        let unused = further.iter().map(|key| self.error_at(key, format!("`{}` is not used", key.get_ref())));
        Ok((whole, UnusedKeys(unused.collect())))
    }

    /// The table `[name]` as a `T`; without such a table, the whole file as a `T`.
    ///
    /// So a file that describes one thing may be written bare, and one that describes several has a table for each.
    ///
    /// # Errors
    /// Where the file is not TOML, or the table not a `T`.
    pub fn section_or_whole<T: DeserializeOwned>(&self, name: &str) -> Result<T, HostError> {
        let document = DeTable::parse(self.file.text()).map_err(|error| self.error(&error))?;
        let section = document.get_ref().iter().find(|(key, _)| key.get_ref() == name);
        let Some((_, section)) = section else { return self.whole() };
        T::deserialize(ValueDeserializer::from(section.clone())).map_err(|error| match error.span() {
            Some(_) => self.error(&error),
            None => self.error_at(section, in_plain_words(error.message())),
        })
    }

    /// An error at a value of this file.
    pub fn error_at<T>(&self, place: &Spanned<T>, message: impl Into<String>) -> HostError {
        self.file.error_at(place.span().start, message)
    }

    /// An error at the character that starts `offset` bytes into the text.
    pub fn error_at_offset(&self, offset: usize, message: impl Into<String>) -> HostError {
        self.file.error_at(offset, message)
    }

    /// An error about the file as a whole, at its first character.
    pub fn error_at_start(&self, message: impl Into<String>) -> HostError {
        self.file.error_at(0, message)
    }

    fn error(&self, error: &Error) -> HostError {
        let start = error.span().map_or(0, |span| span.start);
        self.file.error_at(start, in_plain_words(error.message()))
    }
}

/// What a reader of TOML says, on one line and with types by the names that they have there.
fn in_plain_words(message: &str) -> String {
    let message = message.replace('\n', ", ");
    let Some((found, expected)) = message.rsplit_once("expected ") else { return message };
    let expected = match expected {
        "f64" | "f32" => "a number",
        "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number, not below 0",
        "a sequence" => "a list, [ … ]",
        "a map" => "a table",
        _ if expected.starts_with("struct ") => "a table",
        other => other,
    };
    format!("{found}expected {expected}")
}

#[cfg(test)]
mod tests {
    use super::in_plain_words;

    #[test]
    fn types_have_the_names_that_a_reader_of_toml_knows() {
        for (said, plain) in [
            ("invalid type: boolean `true`, expected f64", "invalid type: boolean `true`, expected a number"),
            (
                "invalid value: integer `-2`, expected u32",
                "invalid value: integer `-2`, expected a whole number, not below 0",
            ),
            ("unclosed table, expected `]`", "unclosed table, expected `]`"),
        ] {
            assert_eq!(in_plain_words(said), plain);
        }
    }
}
