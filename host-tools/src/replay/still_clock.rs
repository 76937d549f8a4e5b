//! Whether the clock stands still while sensors go on: times that are rounded too coarsely for the rows they stand in.

use kapvik_firmware::sensor_frame::SensorFrame;

use crate::data::sensor_channels::values;

/// Fewest frames that tell, and the share of all frames from which it is told: a clock may hiccup.
const LEAST_STILL: u64 = 10;
const TOLERATED: f64 = 0.1;

/// How often the time of a frame was that of the one before.
#[derive(Debug, Clone, Copy, Default)]
pub struct StillClock {
    before: Option<SensorFrame>,
    frames: u64,
    /// Those that have the time of the one before and other readings: the same row twice is no fault of the clock.
    still: u64,
}

impl StillClock {
    /// Takes the next frame.
    pub fn take(&mut self, frame: &SensorFrame) {
        self.frames += 1;
        if let Some(before) = self.before.replace(*frame) {
            let stands = before.time_us == frame.time_us && bits(&before) != bits(frame);
            self.still += u64::from(stands);
        }
    }

    /// What came of it, without capital and stop.
    pub fn told(&self) -> Option<String> {
        let Self { frames, still, .. } = *self;
        (still >= LEAST_STILL && still as f64 > TOLERATED * frames as f64).then(|| {
            format!(
                "{still} of {frames} frames have the time of the frame before and other readings: t_s is rounded too coarsely or stands \
                 still, and these frames are left out"
            )
        })
    }
}

/// Readings that are no number are the same where their bits are.
fn bits(frame: &SensorFrame) -> Vec<Option<u32>> {
    values(frame).into_iter().map(|value| value.map(f32::to_bits)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is said of frames with these times, µs, and readings.
    fn said(frames: impl Iterator<Item = (u64, f32)>) -> Option<String> {
        let mut clock = StillClock::default();
        frames.for_each(|(time_us, angle)| {
            clock.take(&SensorFrame { time_us, rocker_angle_rad: Some(angle), ..SensorFrame::default() });
        });
        clock.told()
    }

    #[test]
    fn fifty_frames_a_second_with_times_to_a_tenth_are_told() {
        let told = said((0..100_u16).map(|row| (100_000 * u64::from(row / 5), row.into())));
        assert!(told.as_ref().is_some_and(|told| told.starts_with("80 of 100 frames have the time")), "{told:?}");
    }

    #[test]
    fn frames_that_come_twice_and_a_clock_that_hiccups_are_not() {
        assert_eq!(said((0..100_u16).map(|row| (100_000 * u64::from(row / 2), (row / 2).into()))), None);
        assert_eq!(said((0..100_u16).map(|row| (100_000 * u64::from(row / 2), f32::NAN))), None);
        assert_eq!(said((0..200_u16).map(|row| (100_000 * u64::from(row.max(12)), row.into()))), None);
    }
}
