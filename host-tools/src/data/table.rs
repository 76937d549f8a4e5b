//! Tables in CSV: a header of column names with their units, then numbers, a field left empty where nothing was measured.

use std::fs;
use std::io::Write;
use std::path::Path;

use csv::{Reader, ReaderBuilder, StringRecord, Terminator, WriterBuilder};

use super::atomic_write::write_atomically;
use super::csv_fault::Fault;
use super::header::Header;
use super::text::TextFile;
use crate::error::HostError;

/// A CSV table, its fields as they were written.
#[derive(Debug, Clone)]
pub struct Table {
    header: Header,
    rows: Vec<Row>,
}

/// A row of a table.
#[derive(Debug, Clone)]
struct Row {
    /// Line of the file, from 1.
    line: u64,
    fields: Vec<String>,
}

/// A column of a table, by its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column(usize);

impl Table {
    /// Reads a table. A byte-order mark, either kind of line end, quoted fields and blanks around names are taken as they come.
    ///
    /// # Errors
    /// Where the file cannot be read or is not UTF-8, leaves a quote open, has a line that ends in a carriage return alone, has no header,
    /// names a column twice, or has a row that is longer or shorter than the header.
    pub fn read(path: &Path) -> Result<Self, HostError> {
        let bytes = fs::read(path).map_err(HostError::file(path))?;
        let header = Header::unread(path);
        let text = str::from_utf8(&bytes).map_err(|error| {
            Fault::of_encoding(&bytes, &error).told(1, |line, field, said| header.error(line, field, said))
        })?;
        Self::parse(&TextFile::new(path, text))
    }

    /// Reads a table from text.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn parse(file: &TextFile) -> Result<Self, HostError> {
        let header = Header::unread(file.path());
        if let Some(fault) = Fault::of(file.text()) {
            return Err(fault.told(1, |line, field, said| header.error(line, field, said)));
        }
        let mut reader = ReaderBuilder::new().has_headers(false).flexible(true).from_reader(file.text().as_bytes());
        let mut table = Self { header, rows: Vec::new() };
        let mut record = StringRecord::new();
        let mut lines = Lines { text: file.text(), offset: 0, line: 1 };
        while table.read_record(&mut reader, &mut record)? {
            let line = lines.of_record(&record);
            let fields: Vec<String> = record.iter().map(str::to_owned).collect();
            if table.header.names().is_empty() {
                table.header.take(line, fields.iter().map(String::as_str))?;
            } else {
                table.header.check_length(line, fields.len())?;
                table.rows.push(Row { line, fields });
            }
        }
        if table.header.names().is_empty() {
            return Err(table.error_in_header("the file is empty: expected a header with the names of the columns"));
        }
        Ok(table)
    }

    fn read_record(&self, reader: &mut Reader<&[u8]>, record: &mut StringRecord) -> Result<bool, HostError> {
        reader.read_record(record).map_err(|error| {
            let line = error.position().map_or(1, csv::Position::line);
            self.header.error(line, 1, format!("not a row of a CSV table: {error}"))
        })
    }

    /// How many rows there are.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there is none but the header.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The names of the columns.
    pub fn header(&self) -> &[String] {
        self.header.names()
    }

    /// The line that the header stands on, from 1.
    pub fn header_line(&self) -> u64 {
        self.header.line()
    }

    /// The column of that name.
    pub fn column(&self, name: &str) -> Option<Column> {
        self.header.position(name).map(Column)
    }

    /// The column of that name, which the caller cannot do without.
    ///
    /// # Errors
    /// Where the header does not have it.
    pub fn required_column(&self, name: &str) -> Result<Column, HostError> {
        self.header.required(name).map(Column)
    }

    /// What is said where there is none of some columns, of which one is needed.
    pub fn no_column(&self, names: &[&str]) -> String {
        self.header.no_column(names)
    }

    /// The column of that name, appended with empty fields if it is not there yet.
    pub fn column_or_append(&mut self, name: &str) -> Column {
        self.column(name).unwrap_or_else(|| {
            self.header.push(name);
            self.rows.iter_mut().for_each(|row| row.fields.push(String::new()));
            Column(self.header.names().len() - 1)
        })
    }

    /// The line of the file that a row stands on, from 1; 1 beyond the table.
    pub fn line(&self, row: usize) -> u64 {
        self.rows.get(row).map_or(1, |row| row.line)
    }

    /// A field as it was written; empty beyond the table.
    pub fn text(&self, row: usize, column: Column) -> &str {
        self.rows.get(row).and_then(|row| row.fields.get(column.0)).map_or("", String::as_str)
    }

    /// A number, or none where the field is empty.
    ///
    /// # Errors
    /// Where the field holds something that is not a finite number.
    pub fn number(&self, row: usize, column: Column) -> Result<Option<f64>, HostError> {
        let text = self.text(row, column).trim();
        if text.is_empty() {
            return Ok(None);
        }
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(Some(number)),
            _ => Err(self.error_at(row, column, format!("`{text}`: expected a finite number, or nothing"))),
        }
    }

    /// Sets a field.
    pub fn set(&mut self, row: usize, column: Column, text: String) {
        if let Some(field) = self.rows.get_mut(row).and_then(|row| row.fields.get_mut(column.0)) {
            *field = text;
        }
    }

    /// An error at a field, which its message names by its column.
    pub fn error_at(&self, row: usize, column: Column, message: impl AsRef<str>) -> HostError {
        self.header.error_at(self.line(row), column.0, message)
    }

    /// An error about the table as a whole, at its header.
    pub fn error_in_header(&self, message: impl Into<String>) -> HostError {
        self.header.error(self.header_line(), 1, message)
    }

    /// Writes the table: beside its place, then renamed there.
    ///
    /// # Errors
    /// Where the file system refuses.
    pub fn write(&self, path: &Path) -> Result<(), HostError> {
        write_atomically(path, |out| self.write_to(out).map_err(|error| HostError::file(path)(error.into())))
    }

    fn write_to(&self, out: &mut dyn Write) -> Result<(), csv::Error> {
        let mut writer = WriterBuilder::new().terminator(Terminator::Any(b'\n')).from_writer(out);
        writer.write_record(self.header.names())?;
        for row in &self.rows {
            writer.write_record(&row.fields)?;
        }
        Ok(writer.flush()?)
    }
}

/// Counts lines up to each record. The reader's own count is one behind where lines end in CR LF, and it counts empty lines to
/// the record that follows them.
struct Lines<'a> {
    text: &'a str,
    offset: usize,
    line: u64,
}

impl Lines<'_> {
    fn of_record(&mut self, record: &StringRecord) -> u64 {
        let start = record.position().map_or(0, |position| position.byte() as usize);
        let rest = self.text.get(start..).unwrap_or("");
        let start = start + rest.len() - rest.trim_start_matches(['\r', '\n']).len();
        let passed = self.text.get(self.offset..start).unwrap_or("");
        self.line += passed.matches('\n').count() as u64;
        self.offset = start;
        self.line
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_is_told_by_its_line() {
        let table = Table::parse(&TextFile::new(Path::new("t.csv"), "\n\nslip\n0.2\n")).expect("a table");
        let said = table.required_column("load_n").expect_err("none").to_string();
        assert!(said.starts_with("t.csv:3:1: no column `load_n`"), "{said}");
        assert!(table.error_in_header("wrong").to_string().starts_with("t.csv:3:1: "));
    }
}
