//! The time of rows of a drive: seconds in the file, whole µs in the program.

use std::fmt::Display;
use std::io::Write;

use super::number_stream::{NumberStream, Row};
use crate::error::HostError;

/// The column of the time.
pub(super) const TIME: &str = "t_s";
/// The latest time, s: up to 2³¹ s, 68 years, seconds with six decimals come back as the same whole number.
const LONGEST_S: f64 = 2_147_483_648.0;

/// The time of a table's rows, which must not fall from row to row.
pub(super) struct TimeColumn {
    place: usize,
    last_us: u64,
}

impl TimeColumn {
    /// That of a table.
    ///
    /// # Errors
    /// Where its header has no time.
    pub(super) fn of(stream: &NumberStream) -> Result<Self, HostError> {
        Ok(Self { place: stream.required_column(TIME)?, last_us: 0 })
    }

    /// The time of the next row, µs.
    ///
    /// # Errors
    /// Where the field holds no time of 0 s or more, or one before the last row's.
    pub(super) fn next(&mut self, stream: &NumberStream, row: &Row) -> Result<u64, HostError> {
        let number: Option<f64> = stream.number(row, self.place)?;
        let refuse = |found: String, expected: &str| {
            Err(stream.error_at(row, self.place, format!("{found}: expected {expected}")))
        };
        let Some(time_s) = number else { return refuse("empty".into(), "a time in s") };
        let Some(time_us) = microseconds(time_s) else {
            return refuse(time_s.to_string(), &format!("a time of 0 s or more, at most {LONGEST_S} s"));
        };
        if time_us < self.last_us {
            return refuse(format!("{time_s}: time runs backwards"), "no earlier time than before");
        }
        self.last_us = time_us;
        Ok(time_us)
    }
}

/// Seconds since the start as µs; `None` where it is no time, or too long for one.
pub fn microseconds(time_s: f64) -> Option<u64> {
    (0.0..=LONGEST_S).contains(&time_s).then(|| libm::round(1.0e6 * time_s) as u64)
}

/// Writes µs as seconds, with no more decimals than it takes.
///
/// # Errors
/// Those of `out`.
pub fn write_seconds(out: &mut dyn Write, time_us: u64) -> std::io::Result<()> {
    let decimals = format!("{:06}", time_us % 1_000_000);
    let decimals = decimals.trim_end_matches('0');
    let point = if decimals.is_empty() { "" } else { "." };
    write!(out, "{}{point}{decimals}", time_us / 1_000_000)
}

/// Writes the header of a table whose first column is the time.
///
/// # Errors
/// Those of `out`.
pub(super) fn write_header(out: &mut dyn Write, names: &[String]) -> std::io::Result<()> {
    writeln!(out, "{TIME},{}", names.join(","))
}

/// Writes a row of such a table, each number in as many digits as lead back to it, and nothing where there is none.
///
/// # Errors
/// Those of `out`.
pub(super) fn write_row(
    out: &mut dyn Write,
    time_us: u64,
    values: impl Iterator<Item = Option<impl Display>>,
) -> std::io::Result<()> {
    write_seconds(out, time_us)?;
    for value in values {
        match value {
            Some(value) => write!(out, ",{value}")?,
            None => write!(out, ",")?,
        }
    }
    writeln!(out)
}
