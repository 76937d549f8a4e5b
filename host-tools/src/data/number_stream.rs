//! Long CSV tables of numbers, row by row: no more than a row is ever in memory.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::str::FromStr;

use csv::{ReaderBuilder, StringRecord};

use super::header::column_names;
use crate::error::HostError;

/// A row longer than this many bytes is refused: such a file is not a table.
const LONGEST_ROW: u64 = 1 << 20;

/// A table that is read from its start to its end.
pub struct NumberStream {
    path: PathBuf,
    input: Box<dyn BufRead>,
    line: u64,
    text: Vec<u8>,
    header: Vec<String>,
}

/// A row of a table: its fields as they were written.
#[derive(Debug, Clone)]
pub struct Row {
    line: u64,
    fields: StringRecord,
}

impl NumberStream {
    /// Opens a table and reads its header.
    ///
    /// # Errors
    /// Where the file cannot be read, or has no header that names each column once.
    pub fn open(path: &Path) -> Result<Self, HostError> {
        let file = File::open(path).map_err(HostError::file(path))?;
        Self::new(path, Box::new(BufReader::new(file)))
    }

    /// A table that comes from elsewhere, under the name of a file.
    ///
    /// # Errors
    /// As [`Self::open`].
    pub fn new(path: &Path, input: Box<dyn BufRead>) -> Result<Self, HostError> {
        let mut stream = Self { path: path.to_path_buf(), input, line: 0, text: Vec::new(), header: Vec::new() };
        let Some(row) = stream.next_row()? else {
            return Err(stream.error(1, 1, "the file is empty: expected a header with the names of the columns"));
        };
        let names = column_names(row.fields.iter());
        stream.header = names.map_err(|wrong| stream.error(row.line, wrong.column, wrong.message))?;
        Ok(stream)
    }

    /// The names of the columns.
    pub fn header(&self) -> &[String] {
        &self.header
    }

    /// Where the column of that name stands.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.header.iter().position(|other| other == name)
    }

    /// Where the column of that name stands, which the caller cannot do without.
    ///
    /// # Errors
    /// Where the header does not have it.
    pub fn required_column(&self, name: &str) -> Result<usize, HostError> {
        let found = || format!("no column `{name}`: expected one in the header (found {})", self.header.join(", "));
        self.column(name).ok_or_else(|| self.error(1, 1, found()))
    }

    /// The next row; `None` at the end. Empty lines are passed over.
    ///
    /// # Errors
    /// Where the file cannot be read, is not UTF-8, has a line that ends in a carriage return alone or leaves a quote open, or a row unlike the
    /// header in length.
    pub fn next_row(&mut self) -> Result<Option<Row>, HostError> {
        loop {
            self.text.clear();
            let read = (&mut self.input).take(LONGEST_ROW).read_until(b'\n', &mut self.text);
            if read.map_err(HostError::file(&self.path))? == 0 {
                return Ok(None);
            }
            self.line += 1;
            if self.line == 1 && self.text.starts_with(b"\xef\xbb\xbf") {
                self.text.drain(..3);
            }
            if self.text.iter().any(|byte| !matches!(byte, b'\n' | b'\r')) {
                return self.row().map(Some);
            }
        }
    }

    fn row(&self) -> Result<Row, HostError> {
        if self.text.len() as u64 == LONGEST_ROW {
            return Err(self.error(self.line, 1, "this row does not end: expected a table of numbers"));
        }
        let text = std::str::from_utf8(&self.text).map_err(|error| {
            let column = String::from_utf8_lossy(&self.text[..error.valid_up_to()]).chars().count() as u64 + 1;
            self.error(self.line, column, "this byte is not UTF-8; expected text in UTF-8")
        })?;
        if let Some(place) = text.trim_end_matches(['\r', '\n']).find('\r') {
            let column = text[..place].matches(',').count() as u64 + 1;
            return Err(self.error(self.line, column, "a line ends in a carriage return alone: expected a line feed"));
        }
        if text.matches('"').count() % 2 == 1 {
            let column = text.rfind('"').map_or(1, |place| text[..place].chars().count() as u64 + 1);
            return Err(self.error(self.line, column, "a quote is not closed: expected another in the same line"));
        }
        let mut fields = StringRecord::new();
        let mut reader = ReaderBuilder::new().has_headers(false).buffer_capacity(1 << 9).from_reader(text.as_bytes());
        reader
            .read_record(&mut fields)
            .map_err(|error| self.error(self.line, 1, format!("not a row of a CSV table: {error}")))?;
        let (length, expected) = (fields.len(), self.header.len());
        if length != expected && !self.header.is_empty() {
            let column = length.min(expected) as u64 + 1;
            let message = format!("{length} fields in this row: expected {expected}, as in the header");
            return Err(self.error(self.line, column, message));
        }
        Ok(Row { line: self.line, fields })
    }

    /// A number of a row, NaN and infinity among them; none where the field is empty.
    ///
    /// # Errors
    /// Where the field holds something else.
    pub fn number<T: FromStr>(&self, row: &Row, column: usize) -> Result<Option<T>, HostError> {
        let text = row.fields.get(column).unwrap_or("").trim();
        if text.is_empty() {
            return Ok(None);
        }
        let number = text.parse::<T>().map(Some);
        number.map_err(|_| self.error_at(row, column, format!("`{text}`: expected a number, or nothing")))
    }

    /// An error at a field, which its message names by its column.
    pub fn error_at(&self, row: &Row, column: usize, message: impl AsRef<str>) -> HostError {
        let name = self.header.get(column).map_or("", String::as_str);
        self.error(row.line, column as u64 + 1, format!("{name}: {}", message.as_ref()))
    }

    /// An error at a place of this file.
    pub fn error(&self, line: u64, column: u64, message: impl Into<String>) -> HostError {
        HostError::Input { path: self.path.clone(), line, column, message: message.into() }
    }
}
