//! How often sensors speak.

use kapvik_firmware::sensor_frame::SensorFrame;

use crate::data::sensor_channels::{names, values};

/// The rhythms of all sensors, as far as the rows that were read tell them.
#[derive(Debug, Clone)]
pub struct Rhythms {
    sensors: Vec<Rhythm>,
}

/// When a sensor spoke last, and how long after the time before it did, for the last two times.
#[derive(Debug, Clone, Copy, Default)]
struct Rhythm {
    last_us: Option<u64>,
    steps_us: [Option<u64>; 2],
}

impl Default for Rhythms {
    fn default() -> Self {
        Self { sensors: vec![Rhythm::default(); names().len()] }
    }
}

impl Rhythms {
    /// Takes the next row.
    pub fn take(&mut self, row: &SensorFrame) {
        for (rhythm, _) in self.sensors.iter_mut().zip(values(row)).filter(|(_, value)| value.is_some()) {
            rhythm.speak(row.time_us);
        }
    }

    /// The period of that sensor in these rows which speaks most often, µs; none where none has spoken twice.
    pub fn shortest_us(&self, rows: [&SensorFrame; 2]) -> Option<u64> {
        let [one, other] = rows.map(values);
        let values = one.into_iter().zip(other);
        let speaking = self.sensors.iter().zip(values).filter(|(_, (one, other))| one.is_some() || other.is_some());
        speaking.filter_map(|(rhythm, _)| rhythm.period_us()).min()
    }
}

impl Rhythm {
    fn speak(&mut self, time_us: u64) {
        let before_us = self.last_us.replace(time_us);
        let step_us = before_us.and_then(|before_us| time_us.checked_sub(before_us)).filter(|step_us| *step_us > 0);
        if step_us.is_some() {
            self.steps_us = [self.steps_us[1], step_us];
        }
    }

    /// The shorter of the last two steps: a reading that is lost makes one longer.
    fn period_us(self) -> Option<u64> {
        self.steps_us.into_iter().flatten().min()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reading_that_is_lost_is_no_other_rhythm() {
        let rocker = |time_us| SensorFrame { time_us, rocker_angle_rad: Some(0.1), ..SensorFrame::default() };
        let mut rhythms = Rhythms::default();
        let mut told = |time_us| {
            rhythms.take(&rocker(time_us));
            rhythms.shortest_us([&rocker(0), &SensorFrame::default()])
        };
        assert_eq!([told(0), told(0), told(1000)], [None, None, Some(1000)]);
        assert_eq!([told(2000), told(4000), told(5000)], [Some(1000); 3]);
        assert_eq!([told(0), told(1000), told(8000)], [Some(1000); 3], "a clock that is set back");
        assert_eq!(rhythms.shortest_us([&SensorFrame::default(); 2]), None);
    }
}
