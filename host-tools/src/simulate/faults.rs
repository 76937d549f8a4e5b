//! Sensors that fail, in some columns for some time.

use std::str::FromStr;

use kapvik_firmware::sensor_frame::SensorFrame;

use super::{RATE_HZ, frame_time_us};
use crate::data::sensor_channels::{names, values, values_mut};

/// How a sensor fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Failure {
    /// It says NaN.
    Nan,
    /// It says infinity.
    Infinity,
    /// It says a million.
    Outlier,
    /// It says minus three times what it would: within its range, and wrong.
    Glitch,
    /// It repeats what it said last before.
    Stuck,
    /// It says exactly zero, as a dead one does to a logger that has no word for it.
    Zero,
    /// It says nothing.
    Dropout,
    /// No frame comes at all.
    SkipFrames,
}

/// Names of the failures on the command line. A frame that repeats is one whose sensors are all stuck.
pub const FAILURES: [(&str, Failure); 9] = [
    ("nan", Failure::Nan),
    ("inf", Failure::Infinity),
    ("outlier", Failure::Outlier),
    ("glitch", Failure::Glitch),
    ("stuck", Failure::Stuck),
    ("zero", Failure::Zero),
    ("dropout", Failure::Dropout),
    ("repeat-frames", Failure::Stuck),
    ("skip-frames", Failure::SkipFrames),
];

/// Those of whole frames, whatever their sensors.
pub const OF_FRAMES: [&str; 2] = ["repeat-frames", "skip-frames"];

/// Columns that fail in one way for some time.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// How.
    pub failure: Failure,
    /// Which columns, in the order of the channels.
    pub columns: Vec<bool>,
    /// From when to when, s, both included.
    pub between_s: (f64, f64),
}

impl Fault {
    /// A fault of the columns that a pattern names: `*` stands for any characters.
    ///
    /// # Errors
    /// Says what was expected where no column fits, or the time is none.
    pub fn new(failure: Failure, pattern: &str, between_s: (f64, f64)) -> Result<Self, String> {
        let columns: Vec<bool> = names().iter().map(|name| fits(pattern, name)).collect();
        if !columns.contains(&true) {
            return Err(format!("`{pattern}`: expected a column such as load_cell_fl_n, or a pattern such as gyro_*"));
        }
        if between_s.0 > between_s.1 || [between_s.0, between_s.1].iter().any(|time| time.is_nan()) {
            return Err(format!("{}-{}: expected two times in s, rising", between_s.0, between_s.1));
        }
        Ok(Self { failure, columns, between_s })
    }

    /// The silences of columns that say something in one of so many frames, of as many a second as there are by default, up to a time, s.
    ///
    /// # Errors
    /// Says what was expected where no column fits.
    pub fn silent_but_one_in(frames: u32, pattern: &str, until_s: f64) -> Result<Vec<Self>, String> {
        let frame_s = 1.0 / RATE_HZ;
        let period_s = f64::from(frames) * frame_s;
        (0..)
            .map(|time| f64::from(time) * period_s)
            .take_while(|start_s| *start_s < until_s)
            .map(|start_s| (start_s + 0.5 * frame_s, start_s + period_s - 0.5 * frame_s))
            .map(|silent_s| Self::new(Failure::Dropout, pattern, silent_s))
            .collect()
    }

    /// A fault as the command line writes it: SENSOR@T1-T2, or @T1-T2 for all sensors; T alone is one frame.
    ///
    /// # Errors
    /// Says what was expected.
    pub fn parse(failure: Failure, text: &str) -> Result<Self, String> {
        let expected = || format!("`{text}`: expected SENSOR@T1-T2 or @T1-T2, times in s");
        let (pattern, times) = text.split_once('@').ok_or_else(expected)?;
        let (start, end) = times.split_once('-').unwrap_or((times, times));
        let time = |text: &str| f64::from_str(text.trim()).ok().filter(|time| time.is_finite()).ok_or_else(expected);
        Self::new(failure, if pattern.is_empty() { "*" } else { pattern }, (time(start)?, time(end)?))
    }

    /// Whether it acts at a time. Half a microsecond is allowed for the rounding of times.
    pub fn acts_at(&self, time_s: f64) -> bool {
        time_s >= self.between_s.0 - 5.0e-7 && time_s <= self.between_s.1 + 5.0e-7
    }

    /// Whether it acts on any of so many frames, so many a second.
    pub fn acts_on_any(&self, frames: u64, rate_hz: f64) -> bool {
        let before = (self.between_s.0 * rate_hz).max(0.0) as u64;
        // Beside the rounding of times: the first frame that is not before its start.
        (before.saturating_sub(1)..frames.min(before.saturating_add(3)))
            .any(|frame| self.acts_at(1.0e-6 * frame_time_us(frame, rate_hz) as f64))
    }
}

/// The faults of a drive, and what the sensors said last before they were stuck.
#[derive(Debug, Clone)]
pub struct Faults {
    faults: Vec<Fault>,
    held: Vec<Option<SensorFrame>>,
}

impl Faults {
    /// These faults.
    pub fn new(faults: Vec<Fault>) -> Self {
        let held = vec![None; faults.len()];
        Self { faults, held }
    }

    /// What comes of a frame; `None` where it is lost.
    pub fn applied(&mut self, frame: &SensorFrame) -> Option<SensorFrame> {
        let time_s = 1.0e-6 * frame.time_us as f64;
        let mut failed = *frame;
        let mut lost = false;
        for (fault, held) in self.faults.iter().zip(&mut self.held) {
            if !fault.acts_at(time_s) {
                *held = Some(*frame);
                continue;
            }
            lost |= fault.failure == Failure::SkipFrames;
            let before = values(held.get_or_insert(*frame));
            for ((value, before), _) in
                values_mut(&mut failed).zip(before).zip(&fault.columns).filter(|(_, fails)| **fails)
            {
                *value = match fault.failure {
                    Failure::Nan => Some(f32::NAN),
                    Failure::Infinity => Some(f32::INFINITY),
                    Failure::Outlier => Some(1.0e6),
                    Failure::Glitch => value.map(|value| -3.0 * value),
                    Failure::Stuck => before,
                    Failure::Zero => Some(0.0),
                    Failure::Dropout => None,
                    Failure::SkipFrames => *value,
                };
            }
        }
        (!lost).then_some(failed)
    }
}

/// Whether a name fits a pattern in which `*` stands for any characters.
fn fits(pattern: &str, name: &str) -> bool {
    let mut parts = pattern.split('*');
    let Some(mut rest) = parts.next().and_then(|first| name.strip_prefix(first)) else { return false };
    let mut last = None;
    for part in parts {
        last = Some(part);
        let Some(place) = rest.find(part) else { return false };
        rest = &rest[place + part.len()..];
    }
    last.map_or(rest.is_empty(), |last| name.ends_with(last))
}
