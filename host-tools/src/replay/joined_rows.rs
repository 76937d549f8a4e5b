//! Rows that are one frame: a logger that gives each message a row of its own parts what the sensors say at one instant.

use std::cell::Cell;
use std::rc::Rc;

use kapvik_firmware::sensor_frame::SensorFrame;

use super::rhythm::Rhythms;
use crate::data::sensor_channels::{values, values_mut};
use crate::error::HostError;

/// So long after the first row of a frame its last may come at any rate, µs: what the sensors of fifty frames a second say between one and the
/// next. Where all of its sensors speak more seldom it may come later, as long as it is nearer to that frame than to the next.
pub const APART_US: u64 = 20_000;

/// Frames, those that follow each other so closely and of which no sensor says something twice as one, with the time of the last of them. One of
/// which no sensor says anything is a frame by itself.
pub struct JoinedRows<I> {
    rows: I,
    /// What has been read and is no part of the frame before.
    next: Option<Result<SensorFrame, HostError>>,
    rhythms: Rhythms,
    joined: Rc<Cell<Joined>>,
}

/// Rows that have become part of the one before.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Joined {
    /// How many.
    pub rows: u64,
    /// The longest after the first row of their frame, µs.
    pub latest_us: u64,
}

impl<I: Iterator<Item = Result<SensorFrame, HostError>>> JoinedRows<I> {
    /// The frames of these rows.
    pub fn of(rows: I) -> Self {
        Self { rows, next: None, rhythms: Rhythms::default(), joined: Rc::default() }
    }

    /// The rows, for whoever asks what they are read from.
    pub fn rows(&self) -> &I {
        &self.rows
    }

    /// What rows have become part of the one before so far; goes on counting.
    pub fn joined(&self) -> Rc<Cell<Joined>> {
        self.joined.clone()
    }

    /// The next row, noted in the rhythms of its sensors.
    fn read(&mut self) -> Option<Result<SensorFrame, HostError>> {
        let row = self.rows.next();
        row.iter().flatten().for_each(|row| self.rhythms.take(row));
        row
    }

    /// How long after a frame began a row comes that may be part of it, µs.
    fn follows(&self, frame: &SensorFrame, begins_us: u64, row: &SensorFrame) -> Option<u64> {
        let after_us = row.time_us.checked_sub(begins_us)?;
        let is_nearer = || self.rhythms.shortest_us([frame, row]).is_some_and(|period_us| after_us < period_us / 2);
        (after_us <= APART_US || is_nearer()).then_some(after_us)
    }
}

impl<I: Iterator<Item = Result<SensorFrame, HostError>>> Iterator for JoinedRows<I> {
    type Item = Result<SensorFrame, HostError>;

    fn next(&mut self) -> Option<Self::Item> {
        let mut frame = match self.next.take().or_else(|| self.read())? {
            Ok(frame) => frame,
            Err(error) => return Some(Err(error)),
        };
        let begins_us = frame.time_us;
        loop {
            let read = self.read();
            let after_us = read.as_ref().and_then(|row| self.follows(&frame, begins_us, row.as_ref().ok()?));
            match (read, after_us) {
                (Some(Ok(row)), Some(after_us)) if add(&mut frame, &row) => {
                    let Joined { rows, latest_us } = self.joined.get();
                    self.joined.set(Joined { rows: rows + 1, latest_us: latest_us.max(after_us) });
                }
                (other, _) => {
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
        (joined.map(|frame| frame.expect("a frame")).collect(), count.get().rows)
    }

    #[test]
    fn messages_of_one_instant_are_one_frame() {
        let (found, joined) = frames(&[rocker(0), camera(7_000), rocker(10_000), rocker(20_000), camera(20_000)]);
        let both = |time_us| SensorFrame { velocity_m_s: camera(0).velocity_m_s, ..rocker(time_us) };
        assert_eq!((found, joined), (vec![both(7_000), rocker(10_000), both(20_000)], 2));
    }

    /// Once it is known that the sensors speak ten times a second, and then while one of them is lost for a while.
    #[test]
    fn what_comes_late_belongs_to_the_nearer_frame() {
        for (late_us, frames_of_both) in [(30_000, 8), (49_000, 8), (50_000, 0), (51_000, 7)] {
            let rows = (0..10).flat_map(|frame| [rocker(100_000 * frame), camera(100_000 * frame + late_us)]);
            let rows: Vec<_> = rows.filter(|row| !(400_000..500_000).contains(&row.time_us)).collect();
            let (found, joined) = frames(&rows);
            let both = found.iter().filter(|frame| values(frame).iter().flatten().count() == 2).count();
            assert_eq!((both as u64, joined), (frames_of_both, frames_of_both), "{late_us} µs late");
        }
    }

    #[test]
    fn seldom_sensors_do_not_join_frames_that_are_far_apart() {
        // Each speaks five times a second, in turns.
        let rows: Vec<_> =
            (0..10).map(|row| if row % 2 == 0 { rocker(100_000 * row) } else { camera(100_000 * row) }).collect();
        assert_eq!(frames(&rows), (rows, 0));
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
