//! Readings that a logger repeats until the sensor has a new one: a camera of 5 Hz in rows of a hundred a second. The filters would take each for
//! a reading by itself, or the sensor for stuck; what is emptied here a seldom sensor has left empty itself.

use std::cell::RefCell;
use std::rc::Rc;

use kapvik_firmware::sensor_frame::SensorFrame;

use crate::data::sensor_channels::{names, values_mut};
use crate::error::HostError;

/// So many stretches of the same reading in a row, alike in length to one, are a logger's habit. Coarse sensors repeat themselves as it comes.
const ALIKE: usize = 6;
/// A stretch that is longer than the habit by more than this is the sensor's own.
const LONGER: u32 = 2;

/// Frames, of which a sensor that is held says something in the first one of each stretch alone; without those in which all are held.
pub struct HeldReadings<I> {
    frames: I,
    stretches: Vec<Stretches>,
    held: Rc<RefCell<Held>>,
}

/// What a logger only repeated.
#[derive(Debug, Clone, Default)]
pub struct Held {
    /// Of each sensor, in the order of its names, whether it was held.
    pub sensors: Vec<bool>,
    /// Rows that said nothing else, and are no frames.
    pub rows: u64,
}

/// How long a sensor said the same.
#[derive(Debug, Clone, Default)]
struct Stretches {
    bits: Option<u32>,
    /// Frames of the stretch that goes on.
    frames: u32,
    /// The last ones before it, the oldest first.
    before: Vec<u32>,
}

impl Stretches {
    /// Takes a reading, and says whether it is none: the one before, held by habit.
    fn is_held(&mut self, bits: u32) -> bool {
        if self.bits == Some(bits) {
            self.frames += 1;
            return self.habit().is_some_and(|longest| self.frames <= longest + LONGER);
        }
        if self.bits.replace(bits).is_some() {
            self.before.push(self.frames);
            let more = self.before.len().saturating_sub(ALIKE);
            self.before.drain(..more);
        }
        self.frames = 1;
        false
    }

    /// The longest of the last stretches, where these are a habit.
    fn habit(&self) -> Option<u32> {
        let [least, most] = [self.before.iter().min()?, self.before.iter().max()?];
        (self.before.len() == ALIKE && *least >= 2 && most - least <= 1).then_some(*most)
    }
}

impl<I> HeldReadings<I> {
    /// The frames of a logger.
    pub fn of(frames: I) -> Self {
        let stretches = vec![Stretches::default(); names().len()];
        let held = Held { sensors: vec![false; stretches.len()], rows: 0 };
        let held = Rc::new(RefCell::new(held));
        Self { frames, stretches, held }
    }

    /// Empties what is held. A frame of which that leaves nothing is none, but one in which no sensor spoke stays.
    fn says_anything_new(&mut self, frame: &mut SensorFrame) -> bool {
        let mut held = self.held.borrow_mut();
        let sensors = self.stretches.iter_mut().zip(held.sensors.iter_mut());
        let (mut spoken, mut emptied) = (0, 0);
        for (value, (stretches, held)) in values_mut(frame).zip(sensors) {
            spoken += usize::from(value.is_some());
            if value.is_some_and(|reading| stretches.is_held(reading.to_bits())) {
                (*value, *held) = (None, true);
                emptied += 1;
            }
        }
        let says = emptied == 0 || emptied < spoken;
        held.rows += u64::from(!says);
        says
    }

    /// The frames as the logger wrote them.
    pub fn frames(&self) -> &I {
        &self.frames
    }

    /// What was held so far; goes on counting.
    pub fn held(&self) -> Rc<RefCell<Held>> {
        self.held.clone()
    }
}

impl<I: Iterator<Item = Result<SensorFrame, HostError>>> Iterator for HeldReadings<I> {
    type Item = Result<SensorFrame, HostError>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let mut frame = match self.frames.next()? {
                Ok(frame) => frame,
                Err(error) => return Some(Err(error)),
            };
            if self.says_anything_new(&mut frame) {
                return Some(Ok(frame));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Which frames of these readings say something, beside a sensor that always does.
    fn said(readings: &[f32]) -> Vec<bool> {
        let frames = readings.iter().zip(0_u16..).map(|(reading, number)| {
            let mut frame = SensorFrame { rocker_angle_rad: Some(number.into()), ..SensorFrame::default() };
            frame.velocity_m_s.x = Some(*reading);
            Ok(frame)
        });
        HeldReadings::of(frames).map(|frame| frame.expect("a frame").velocity_m_s.x.is_some()).collect()
    }

    #[test]
    fn rows_that_only_repeat_are_no_frames() {
        let frames = (0..40_u16)
            .map(|row| Ok(SensorFrame { rocker_angle_rad: Some((row / 2).into()), ..SensorFrame::default() }));
        let frames = HeldReadings::of(frames);
        let held = frames.held();
        let said: Vec<f32> = frames.filter_map(|frame| frame.expect("a frame").rocker_angle_rad).collect();
        // Six stretches are taken as they come, of the others one row each.
        assert_eq!((said.len(), held.borrow().rows), (2 * 6 + 1 + 13, 14));
        let silent = (0..5).map(|_| Ok(SensorFrame::default()));
        assert_eq!(HeldReadings::of(silent).count(), 5);
    }

    #[test]
    fn a_reading_that_is_held_by_habit_counts_once() {
        let readings: Vec<f32> = (0..60).map(|frame| (frame / 5) as f32).collect();
        let said = said(&readings);
        // The seventh stretch begins when six are known.
        assert!(said[..31].iter().all(|said| *said));
        assert!((31..60).all(|frame| said[frame] == (frame % 5 == 0)), "{said:?}");
    }

    #[test]
    fn a_sensor_that_sticks_or_is_coarse_goes_on_saying_so() {
        let mut readings: Vec<f32> = (0..45).map(|frame| (frame / 5) as f32).collect();
        readings.extend([8.0; 20]);
        let stuck = said(&readings);
        assert!(stuck[45 + LONGER as usize..].iter().all(|said| *said), "{stuck:?}");
        let coarse: Vec<f32> = [2, 7, 3, 2, 9, 4, 2, 5, 3, 8]
            .iter()
            .zip(0..)
            .flat_map(|(frames, value)| vec![value as f32; *frames])
            .collect();
        assert!(said(&coarse).iter().all(|said| *said));
        let changing: Vec<f32> = (0..40).map(|frame| frame as f32).collect();
        assert!(said(&changing).iter().all(|said| *said));
    }
}
