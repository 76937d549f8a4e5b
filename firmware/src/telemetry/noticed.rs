//! What a frame changed in the estimator that is worth a line in the log.

use crate::estimator::{EstimatorHealth, PerSensor, Sensor, SensorHealth};
use crate::pipeline::FrameEstimate;

/// Whether a sensor was taken out of use, or is used again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum SensorChange {
    /// It was bad for so long that it is out of use.
    Dropped,
    /// It proved itself.
    Restored,
}

/// What a frame changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Noticed {
    /// The soil is another one: how many changes there were since the start.
    pub soil_changes: Option<u16>,
    /// Filters that were reset to their stated floor.
    pub filter_resets: u32,
    /// Filters that gave up what they believed.
    pub relearned: u32,
    /// How often the filters started anew: after a long gap, or a clock set back.
    pub gaps: u32,
    out_of_use_before: OutOfUse,
    out_of_use: OutOfUse,
}

impl Noticed {
    /// Tells each sensor that was dropped or is used again.
    pub fn for_each_sensor(&self, mut tell: impl FnMut(Sensor, SensorChange)) {
        for (place, sensor) in Sensor::all().iter().enumerate() {
            match (self.out_of_use_before.has(place), self.out_of_use.has(place)) {
                (false, true) => tell(*sensor, SensorChange::Dropped),
                (true, false) => tell(*sensor, SensorChange::Restored),
                _ => {}
            }
        }
    }
}

/// Which sensors are out of use: a bit for each, in the order of [`PerSensor::iter`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct OutOfUse(u32);

impl OutOfUse {
    fn of(sensors: &PerSensor<SensorHealth>) -> Self {
        // Its steps are written as a loop: what `fold` is given would be repeated for each kind of sensor.
        let mut bits = 0;
        for (place, health) in sensors.iter().enumerate() {
            bits |= u32::from(health.dropped) << place;
        }
        Self(bits)
    }

    fn has(self, place: usize) -> bool {
        self.0 >> place & 1 == 1
    }
}

/// Remembers of the frame before what the next one is compared with.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Watch {
    soil_changes: u16,
    filter_resets: u32,
    relearned: u32,
    gaps: u32,
    out_of_use: OutOfUse,
}

impl Watch {
    /// What is new since the frame before.
    pub fn notice(&mut self, health: &EstimatorHealth, estimate: &FrameEstimate) -> Noticed {
        let now = Self {
            soil_changes: estimate.soil.as_ref().map_or(self.soil_changes, |soil| soil.changes),
            filter_resets: health.filter_resets,
            relearned: health.relearned,
            gaps: health.gaps,
            out_of_use: OutOfUse::of(&health.sensors),
        };
        let before = core::mem::replace(self, now);
        Noticed {
            soil_changes: (now.soil_changes > before.soil_changes).then_some(now.soil_changes),
            filter_resets: now.filter_resets.saturating_sub(before.filter_resets),
            relearned: now.relearned.saturating_sub(before.relearned),
            gaps: now.gaps.saturating_sub(before.gaps),
            out_of_use_before: before.out_of_use,
            out_of_use: now.out_of_use,
        }
    }
}
