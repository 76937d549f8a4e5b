//! What a frame changed in the estimator that is worth a line in the log.

use crate::estimator::{EstimatorHealth, PerSensor, Sensor};
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
    /// Gaps after which the filters started anew.
    pub gaps: u32,
    sensors: PerSensor<Option<(Sensor, SensorChange)>>,
}

impl Noticed {
    /// Each sensor that was dropped or is used again.
    pub fn sensors(&self) -> impl Iterator<Item = (Sensor, SensorChange)> {
        self.sensors.iter().flatten().copied()
    }
}

/// Remembers of the frame before what the next one is compared with.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Watch {
    soil_changes: u16,
    filter_resets: u32,
    relearned: u32,
    gaps: u32,
    dropped: PerSensor<bool>,
}

impl Watch {
    /// What is new since the frame before.
    pub fn notice(&mut self, health: &EstimatorHealth, estimate: &FrameEstimate) -> Noticed {
        let now = Self {
            soil_changes: estimate.soil.as_ref().map_or(self.soil_changes, |soil| soil.changes),
            filter_resets: health.filter_resets,
            relearned: health.relearned,
            gaps: health.gaps,
            dropped: health.sensors.map(|health| health.dropped),
        };
        let before = core::mem::replace(self, now);
        let changes = before.dropped.zip_map(now.dropped, |before, after| match (before, after) {
            (false, true) => Some(SensorChange::Dropped),
            (true, false) => Some(SensorChange::Restored),
            _ => None,
        });
        Noticed {
            soil_changes: (now.soil_changes > before.soil_changes).then_some(now.soil_changes),
            filter_resets: now.filter_resets.saturating_sub(before.filter_resets),
            relearned: now.relearned.saturating_sub(before.relearned),
            gaps: now.gaps.saturating_sub(before.gaps),
            sensors: changes.zip_map(Sensor::all(), |change, sensor| change.map(|change| (sensor, change))),
        }
    }
}
