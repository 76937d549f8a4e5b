//! What can go wrong with the sensors.

use kapvik_firmware::estimator::{Sensor, SensorHealth};

use crate::data::sensor_channels::sensor_name;
use crate::error::HostError;
use crate::simulate::faults::{Failure, Fault, Faults};

/// The failures of a single sensor.
pub const SENSOR_FAILURES: [Failure; 5] =
    [Failure::Nan, Failure::Infinity, Failure::Outlier, Failure::Stuck, Failure::Dropout];

/// So many repetitions of a reading are still believed: a good sensor may say the same again.
const BELIEVED_FRAMES: u16 = 2;

/// What goes wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Case {
    /// One sensor fails.
    Sensor(Sensor, Failure),
    /// All sensors repeat what they said last, while time goes on.
    RepeatedReadings,
    /// Every frame comes twice.
    RepeatedFrames,
    /// No frame comes.
    SkippedFrames,
}

impl Case {
    /// The whole catalogue: each failure of each sensor, then those of whole frames.
    pub fn all() -> Vec<Self> {
        let sensors = Sensor::all();
        let of_sensors =
            sensors.iter().flat_map(|sensor| SENSOR_FAILURES.map(|failure| Self::Sensor(*sensor, failure)));
        of_sensors.chain([Self::RepeatedReadings, Self::RepeatedFrames, Self::SkippedFrames]).collect()
    }

    /// The faults that make it, between two times in s.
    ///
    /// # Errors
    /// Where the times are not in order.
    pub fn faults(self, between_s: (f64, f64)) -> Result<Faults, HostError> {
        let (failure, columns) = match self {
            Self::Sensor(sensor, failure) => (failure, sensor_name(sensor)),
            Self::RepeatedReadings => (Failure::Stuck, "*".to_owned()),
            Self::SkippedFrames => (Failure::SkipFrames, "*".to_owned()),
            Self::RepeatedFrames => return Ok(Faults::new(Vec::new())),
        };
        Fault::new(failure, &columns, between_s).map(|fault| Faults::new(vec![fault])).map_err(HostError::Failed)
    }

    /// What the gates must count of a sensor in so many frames of it.
    pub fn counts(self, sensor: Sensor, frames: u16) -> GateCounts {
        let healthy = GateCounts::default();
        let failure = match self {
            Self::Sensor(failing, failure) if failing == sensor => failure,
            Self::RepeatedReadings => Failure::Stuck,
            _ => return healthy,
        };
        match failure {
            Failure::Nan | Failure::Infinity => GateCounts { not_finite: frames, ..healthy },
            Failure::Outlier => GateCounts { out_of_range: frames, ..healthy },
            Failure::Stuck => GateCounts { stuck: frames.saturating_sub(BELIEVED_FRAMES), ..healthy },
            Failure::Dropout => GateCounts { missing: frames, ..healthy },
            // No sensor of the catalogue says zero.
            Failure::Glitch | Failure::Zero | Failure::SkipFrames => healthy,
        }
    }
}

/// Readings that the gates withhold for what they are. What surprises a filter, and how long a sensor is on probation, is left
/// to the estimator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct GateCounts {
    missing: u16,
    not_finite: u16,
    out_of_range: u16,
    stuck: u16,
}

impl GateCounts {
    fn of(health: &SensorHealth) -> Self {
        let SensorHealth { missing, not_finite, out_of_range, stuck, .. } = *health;
        Self { missing, not_finite, out_of_range, stuck }
    }

    /// Whether they are what was counted between two states of a sensor's health.
    pub fn accounts_for(&self, before: &SensorHealth, after: &SensorHealth) -> bool {
        let before = Self::of(before);
        let sum = Self {
            missing: before.missing + self.missing,
            not_finite: before.not_finite + self.not_finite,
            out_of_range: before.out_of_range + self.out_of_range,
            stuck: before.stuck + self.stuck,
        };
        sum == Self::of(after)
    }
}
