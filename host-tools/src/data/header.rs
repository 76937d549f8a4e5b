//! The header of a table: each column's name, once.

use std::path::{Path, PathBuf};

use crate::error::HostError;

/// The header of a table, and the file that it stands in.
#[derive(Debug, Clone)]
pub struct Header {
    path: PathBuf,
    /// Line of the file, from 1.
    line: u64,
    names: Vec<String>,
}

impl Header {
    /// Of a table whose names are yet to be read.
    pub fn unread(path: &Path) -> Self {
        Self { path: path.to_path_buf(), line: 1, names: Vec::new() }
    }

    /// Takes the names of the columns from the fields of a line, blanks around them taken off.
    ///
    /// # Errors
    /// Where something else than commas seems to part the columns, there are remarks in place of names, a column without a name, or a name
    /// twice.
    pub fn take<'a>(&mut self, line: u64, fields: impl Iterator<Item = &'a str>) -> Result<(), HostError> {
        self.line = line;
        self.names = column_names(fields).map_err(|wrong| self.error(line, wrong.column, wrong.message))?;
        Ok(())
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The line that it stands on, from 1; 1 before it is read.
    pub fn line(&self) -> u64 {
        self.line
    }

    /// The names of the columns; none before they are read.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Where the column of that name stands.
    pub fn position(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|other| other == name)
    }

    /// Where the column of that name stands, which the caller cannot do without.
    ///
    /// # Errors
    /// Where there is none.
    pub fn required(&self, name: &str) -> Result<usize, HostError> {
        self.position(name).ok_or_else(|| self.error(self.line, 1, self.no_column(&[name])))
    }

    /// What is said where there is none of some columns, of which one is needed.
    pub fn no_column(&self, names: &[&str]) -> String {
        let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
        let found = self.names.join(", ");
        format!("no column {}: expected one in the header (found {found})", names.join(" or "))
    }

    /// Appends a column.
    pub fn push(&mut self, name: &str) {
        self.names.push(name.to_owned());
    }

    /// Refuses a row of so many fields where that is not as many as there are names.
    ///
    /// # Errors
    /// At the first field that is missing or too many.
    pub fn check_length(&self, line: u64, length: usize) -> Result<(), HostError> {
        let expected = self.names.len();
        if length == expected {
            return Ok(());
        }
        let column = length.min(expected) as u64 + 1;
        Err(self.error(line, column, format!("{length} fields in this row: expected {expected}, as in the header")))
    }

    /// An error at a field, which its message names by its column.
    pub fn error_at(&self, line: u64, column: usize, message: impl AsRef<str>) -> HostError {
        let name = self.names.get(column).map_or("", String::as_str);
        self.error(line, column as u64 + 1, format!("{name}: {}", message.as_ref()))
    }

    /// An error at a place of the file.
    pub fn error(&self, line: u64, column: u64, message: impl Into<String>) -> HostError {
        HostError::Input { path: self.path.clone(), line, column, message: message.into() }
    }
}

/// What is wrong with a header.
struct HeaderError {
    /// The column, from 1.
    column: u64,
    /// What was expected.
    message: String,
}

/// What parts columns in other tables, as it is told and as it is.
const OTHER_SEPARATORS: [(&str, char); 2] = [("semicolons", ';'), ("tabs", '\t')];

fn column_names<'a>(fields: impl Iterator<Item = &'a str>) -> Result<Vec<String>, HeaderError> {
    let names: Vec<String> = fields.map(|name| name.trim().to_owned()).collect();
    if let [all] = names.as_slice()
        && let Some((shown, _)) = OTHER_SEPARATORS.iter().find(|(_, separator)| all.contains(*separator))
    {
        return Err(HeaderError { column: 1, message: format!("columns are parted by {shown}: expected commas") });
    }
    for (place, name) in names.iter().enumerate() {
        let error = |message: String| Err(HeaderError { column: place as u64 + 1, message });
        if place == 0 && name.starts_with('#') {
            return error("remarks: expected the names of the columns ahead of everything else".to_owned());
        }
        if name.is_empty() {
            return error("this column has no name: expected one in the header".to_owned());
        }
        if names.iter().take(place).any(|other| other == name) {
            return error(format!("a second column is named `{name}`: expected each name once"));
        }
    }
    Ok(names)
}
