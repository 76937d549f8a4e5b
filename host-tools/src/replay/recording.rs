//! A file of sensor frames, opened, with the rover that recorded it.

use std::cell::{Cell, RefCell};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;
use std::rc::Rc;

use indicatif::{ProgressBar, ProgressFinish, ProgressStyle};
use kapvik_firmware::rover::Rover;

use super::held_readings::{Held, HeldReadings};
use super::joined_rows::{APART_US, Joined, JoinedRows};
use crate::data::assumed_keys::AssumedKeys;
use crate::data::frame_file::FrameReader;
use crate::data::number_stream::NumberStream;
use crate::data::rover_file::RoverFile;
use crate::data::sensor_channels::names;
use crate::error::HostError;

/// A recording.
pub struct Recording {
    /// The rover.
    pub rover: Rover<f64>,
    /// What of it is assumed.
    pub assumed: AssumedKeys,
    /// The frames, read as they are asked for.
    pub frames: HeldReadings<JoinedRows<FrameReader>>,
}

/// What a person should know of how a recording was read.
#[derive(Debug, Clone, Default)]
pub struct Remarks {
    /// Columns that are passed over; a name may be misspelt.
    unknown_columns: Vec<String>,
    /// Rows that have become part of others.
    joined: Rc<Cell<Joined>>,
    /// Readings that are repeated until there is a new one.
    held: Rc<RefCell<Held>>,
}

impl Remarks {
    /// Line by line, once all frames are read.
    pub fn lines(&self) -> Vec<String> {
        let unknown = (!self.unknown_columns.is_empty())
            .then(|| format!("columns that name no sensor, and are not used: {}", self.unknown_columns.join(", ")));
        let Joined { rows, latest_us } = self.joined.get();
        let joined = (rows > 0).then(|| {
            let apart_ms = latest_us.max(APART_US).div_ceil(1000);
            format!(
                "rows merged into the frame before, up to {apart_ms} ms earlier, of which they repeat no sensor: {rows}"
            )
        });
        unknown.into_iter().chain(joined).chain(held_in_words(&self.held.borrow())).collect()
    }
}

impl Recording {
    /// What a person should know of how it was read; counts go on while frames are read.
    pub fn remarks(&self) -> Remarks {
        let rows = self.frames.frames();
        Remarks { unknown_columns: rows.rows().unknown_columns(), joined: rows.joined(), held: self.frames.held() }
    }

    /// Opens a file of frames behind a progress bar, which a terminal alone shows. Without a rover file the rover is the
    /// assumed set K0.
    ///
    /// # Errors
    /// Where a file cannot be read, the frames have no header, or there can be no such rover.
    pub fn open(frames: &Path, rover: Option<&Path>) -> Result<Self, HostError> {
        let RoverFile { rover, assumed, .. } = RoverFile::read_or_assumed(rover)?;
        let file = File::open(frames).map_err(HostError::file(frames))?;
        let length = file.metadata().map_err(HostError::file(frames))?.len();
        let input = BufReader::new(progress_bar(length).wrap_read(file));
        let frames = FrameReader::new(NumberStream::new(frames, Box::new(input))?)?;
        Ok(Self { rover, assumed, frames: HeldReadings::of(JoinedRows::of(frames)) })
    }
}

/// Which sensors were held, and what became of their rows; nothing where none was.
fn held_in_words(Held { sensors, rows }: &Held) -> Option<String> {
    let held = names().into_iter().zip(sensors).filter(|(_, is_held)| **is_held);
    let held: Vec<String> = held.map(|(name, _)| name).collect();
    let no_frames = match *rows {
        0 => String::new(),
        rows => format!("; rows that say nothing else, which are no frames and have no estimates: {rows}"),
    };
    (!held.is_empty()).then(|| {
        format!(
            "sensors whose reading each row repeats until there is a new one, which counts once: {}{no_frames}",
            held.join(", ")
        )
    })
}

/// Of a file of that many bytes; 0 where nobody knows.
fn progress_bar(bytes: u64) -> ProgressBar {
    let template = match bytes {
        0 => "{spinner} {bytes} {elapsed}",
        _ => "{wide_bar} {bytes} of {total_bytes} {eta}",
    };
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    let bar = if bytes == 0 { ProgressBar::new_spinner() } else { ProgressBar::new(bytes) };
    bar.with_style(style).with_finish(ProgressFinish::AndClear)
}
