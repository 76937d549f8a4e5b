//! Rows that are one frame: a logger that gives each message a row of its own parts what the sensors say at one instant.

use std::cell::Cell;
use std::rc::Rc;

use kapvik_firmware::sensor_frame::SensorFrame;

use crate::data::sensor_channels::{values, values_mut};
use crate::error::HostError;

/// So long after the first row of a frame its last may come, µs: what the sensors of fifty frames a second say between one and the next.
pub const APART_US: u64 = 20_000;

/// Frames, those that follow each other within [`APART_US`] and of which no sensor says something twice as one, with the time of the last of
/// them. One of which no sensor says anything is a frame by itself.
pub struct JoinedRows<I> {
    rows: I,
    /// What has been read and is no part of the frame before.
    next: Option<Result<SensorFrame, HostError>>,
    joined: Rc<Cell<u64>>,
}

impl<I: Iterator<Item = Result<SensorFrame, HostError>>> JoinedRows<I> {
    /// The frames of these rows.
    pub fn of(rows: I) -> Self {
        Self { rows, next: None, joined: Rc::default() }
    }

    /// The rows, for whoever asks what they are read from.
    pub fn rows(&self) -> &I {
        &self.rows
    }

    /// How many rows have become part of the one before so far; goes on counting.
    pub fn joined(&self) -> Rc<Cell<u64>> {
        self.joined.clone()
    }
}

impl<I: Iterator<Item = Result<SensorFrame, HostError>>> Iterator for JoinedRows<I> {
    type Item = Result<SensorFrame, HostError>;

    fn next(&mut self) -> Option<Self::Item> {
        let mut frame = match self.next.take().or_else(|| self.rows.next())? {
            Ok(frame) => frame,
            Err(error) => return Some(Err(error)),
        };
        let begins_us = frame.time_us;
        let follows = |row: &SensorFrame| row.time_us.checked_sub(begins_us).is_some_and(|after| after <= APART_US);
        loop {
            match self.rows.next() {
                Some(Ok(row)) if follows(&row) && add(&mut frame, &row) => {
                    self.joined.set(self.joined.get() + 1);
                }
                other => {
                    self.next = other;
                    return Some(Ok(frame));
                }
            }
        }
    }
}

/// Adds what a row says to a frame, where both say something and no sensor in both of them.
fn add(frame: &mut SensorFrame, row: &SensorFrame) -> bool {
    let [of_frame, of_row] = [values(frame), values(row)];
    let both_speak = [&of_frame, &of_row].iter().all(|values| values.iter().any(Option::is_some));
    let is_apart = || of_frame.iter().zip(&of_row).all(|(one, other)| one.is_none() || other.is_none());
    let adds = both_speak && is_apart();
    if adds {
        values_mut(frame).zip(of_row).for_each(|(value, said)| *value = value.or(said));
        frame.time_us = row.time_us;
    }
    adds
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rocker(time_us: u64) -> SensorFrame {
        SensorFrame { time_us, rocker_angle_rad: Some(0.1), ..SensorFrame::default() }
    }

    fn camera(time_us: u64) -> SensorFrame {
        let mut frame = SensorFrame { time_us, ..SensorFrame::default() };
        frame.velocity_m_s.x = Some(0.02);
        frame
    }

    fn frames(rows: &[SensorFrame]) -> (Vec<SensorFrame>, u64) {
        let joined = JoinedRows::of(rows.iter().copied().map(Ok));
        let count = joined.joined();
        (joined.map(|frame| frame.expect("a frame")).collect(), count.get())
    }

    #[test]
    fn messages_of_one_instant_are_one_frame() {
        let (found, joined) = frames(&[rocker(0), camera(7_000), rocker(10_000), rocker(20_000), camera(20_000)]);
        let both = |time_us| SensorFrame { velocity_m_s: camera(0).velocity_m_s, ..rocker(time_us) };
        assert_eq!((found, joined), (vec![both(7_000), rocker(10_000), both(20_000)], 2));
    }

    #[test]
    fn other_rows_stay_as_they_are() {
        let cases = [
            // A frame that comes twice, a sensor that is silent for one frame of ten a second, and nothing at all.
            [rocker(0), rocker(0)],
            [rocker(0), camera(100_000)],
            [rocker(0), SensorFrame { time_us: 5_000, ..SensorFrame::default() }],
            [SensorFrame::default(), rocker(5_000)],
            // A clock that was set back.
            [rocker(500_000), camera(100_000)],
        ];
        for rows in cases {
            assert_eq!(frames(&rows), (rows.to_vec(), 0));
        }
    }

    #[test]
    fn an_error_comes_after_what_was_read_before_it() {
        let rows = [Ok(rocker(0)), Err(HostError::Failed("torn".to_owned()))];
        let mut joined = JoinedRows::of(rows.into_iter());
        assert_eq!(joined.next().expect("a row").expect("a frame"), rocker(0));
        assert!(joined.next().expect("a row").is_err());
        assert!(joined.next().is_none());
    }
}
