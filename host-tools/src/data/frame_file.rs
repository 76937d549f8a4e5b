//! Sensor frames in CSV, one row each: read and written frame by frame.

use std::io::Write;
use std::path::Path;

use kapvik_firmware::sensor_frame::SensorFrame;

use super::misspelling::{other_columns, refuse_misspelt};
use super::number_stream::{NumberStream, Row};
use super::sensor_channels::{names, values, values_mut};
use super::time_column::{self, TimeColumn};
use crate::error::HostError;

/// The frames of a file, in the order of time.
///
/// Needed are `t_s`, which must not fall from row to row, and at least one sensor. A sensor without a column is absent, one
/// with an empty field gave nothing in that frame, and columns of other names are passed over, but not those that seem to be a
/// sensor's. `NaN` and `inf` are values: a sensor may say so, and it is for the flight software to refuse them.
pub struct FrameReader {
    stream: NumberStream,
    time: TimeColumn,
    /// Where each sensor stands in a row, in the order of the channels.
    columns: Vec<Option<usize>>,
    /// No row has been read yet.
    is_empty: bool,
}

impl FrameReader {
    /// Opens a file of frames.
    ///
    /// # Errors
    /// Where it cannot be read, or its header has no time or no sensor.
    pub fn open(path: &Path) -> Result<Self, HostError> {
        Self::new(NumberStream::open(path)?)
    }

    /// The frames of a table.
    ///
    /// # Errors
    /// Where its header has no time or no sensor, or a column that is nearly one of a sensor which it has not.
    pub fn new(stream: NumberStream) -> Result<Self, HostError> {
        let time = TimeColumn::of(&stream)?;
        let names = names();
        let columns: Vec<_> = names.iter().map(|name| stream.column(name)).collect();
        if columns.iter().all(Option::is_none) {
            let expected = "no sensor: expected columns such as wheel_rate_fl_rad_s, load_cell_fl_n, accel_x_m_s2";
            return Err(
                stream.error_in_header(1, format!("{expected} in the header (found {})", stream.header().join(", ")))
            );
        }
        refuse_misspelt(&stream, &names, "sensor")?;
        Ok(Self { stream, time, columns, is_empty: true })
    }

    /// The columns that are passed over, such as those of a sensor whose name is not quite right.
    pub fn unknown_columns(&self) -> Vec<String> {
        other_columns(&self.stream, &names()).map(|(_, name)| name.clone()).collect()
    }

    fn frame(&mut self, row: &Row) -> Result<SensorFrame, HostError> {
        let time_us = self.time.next(&self.stream, row)?;
        let mut frame = SensorFrame { time_us, ..SensorFrame::default() };
        for (value, column) in values_mut(&mut frame).zip(&self.columns) {
            if let Some(column) = *column {
                *value = self.stream.number(row, column)?;
            }
        }
        Ok(frame)
    }
}

impl Iterator for FrameReader {
    type Item = Result<SensorFrame, HostError>;
    fn next(&mut self) -> Option<Self::Item> {
        let row = self.stream.next_row().transpose();
        let is_first = std::mem::replace(&mut self.is_empty, false);
        match row {
            Some(row) => Some(row.and_then(|row| self.frame(&row))),
            None => is_first.then(|| Err(self.stream.error_below_header("no frame: expected one below the header"))),
        }
    }
}

/// Whether a table is one of sensor frames, by its header: a column of a sensor, or one that is named like an encoder's.
///
/// # Errors
/// Where the file cannot be read, or has no header that names each column once.
pub fn is_one(path: &Path) -> Result<bool, HostError> {
    let stream = NumberStream::open(path)?;
    let like_an_encoder = |name: &String| name.starts_with("wheel_rate_") && name != "wheel_rate_rad_s";
    let sensors = names();
    Ok(stream.header().iter().any(|name| sensors.contains(name) || like_an_encoder(name)))
}

/// Writes the header of a file of frames, with a column for every sensor.
///
/// # Errors
/// Those of `out`.
pub fn write_header(out: &mut dyn Write) -> std::io::Result<()> {
    time_column::write_header(out, &names())
}

/// Writes a frame as a row, each number in as many digits as lead back to it.
///
/// # Errors
/// Those of `out`.
pub fn write_frame(out: &mut dyn Write, frame: &SensorFrame) -> std::io::Result<()> {
    time_column::write_row(out, frame.time_us, values(frame).into_iter())
}
