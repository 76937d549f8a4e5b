//! Long CSV tables of numbers, row by row: no more than a row is ever in memory.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::str::FromStr;

use csv::{ReaderBuilder, StringRecord};

use super::csv_fault::Fault;
use super::header::Header;
use crate::error::HostError;

/// A row longer than this many bytes is refused: such a file is not a table.
const LONGEST_ROW: u64 = 1 << 20;

/// A table that is read from its start to its end.
pub struct NumberStream {
    header: Header,
    input: Box<dyn BufRead>,
    line: u64,
    text: Vec<u8>,
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
        let mut stream = Self { header: Header::unread(path), input, line: 0, text: Vec::new() };
        let Some(row) = stream.next_row()? else {
            return Err(stream.error(1, 1, "the file is empty: expected a header with the names of the columns"));
        };
        stream.header.take(row.line, row.fields.iter())?;
        Ok(stream)
    }

    /// The names of the columns.
    pub fn header(&self) -> &[String] {
        self.header.names()
    }

    /// Where the column of that name stands.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.header.position(name)
    }

    /// Where the column of that name stands, which the caller cannot do without.
    ///
    /// # Errors
    /// Where the header does not have it.
    pub fn required_column(&self, name: &str) -> Result<usize, HostError> {
        self.header.required(name)
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
            if read.map_err(HostError::file(self.header.path()))? == 0 {
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
        let told = |fault: Fault| fault.told(self.line, |line, field, said| self.error(line, field, said));
        let text = str::from_utf8(&self.text).map_err(|error| told(Fault::of_encoding(&self.text, &error)))?;
        if let Some(fault) = Fault::of(text) {
            return Err(told(fault));
        }
        let mut fields = StringRecord::new();
        let mut reader = ReaderBuilder::new().has_headers(false).buffer_capacity(1 << 9).from_reader(text.as_bytes());
        reader
            .read_record(&mut fields)
            .map_err(|error| self.error(self.line, 1, format!("not a row of a CSV table: {error}")))?;
        if !self.header.names().is_empty() {
            self.header.check_length(self.line, fields.len())?;
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
        self.header.error_at(row.line, column, message)
    }

    /// An error at a column of the header, from 1.
    pub fn error_in_header(&self, column: u64, message: impl Into<String>) -> HostError {
        self.error(self.header.line(), column, message)
    }

    /// An error below the header.
    pub fn error_below_header(&self, message: impl Into<String>) -> HostError {
        self.error(self.header.line() + 1, 1, message)
    }

    /// An error at a place of this file.
    pub fn error(&self, line: u64, column: u64, message: impl Into<String>) -> HostError {
        self.header.error(line, column, message)
    }
}
