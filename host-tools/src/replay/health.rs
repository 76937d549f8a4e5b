//! Which sensors gave trouble, and what kind.

use kapvik_firmware::estimator::{EstimatorHealth, Sensor, SensorHealth};

use crate::data::sensor_channels::sensor_name;

/// A sensor whose readings were not all used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SensorTrouble {
    /// Its column in files of frames.
    pub sensor: String,
    /// How often for what reason; reasons that never occurred are left out.
    pub reasons: Vec<(&'static str, u16)>,
    /// It was out of use at the end.
    pub dropped: bool,
}

/// What an encoder counts that says the same over and over: a wheel that turns evenly does, and it is believed less, but used.
pub const REPEATS: &str = "repeated";
/// Why a reading is not used.
pub const REASONS: [&str; 6] = ["missing", "not finite", "out of range", "stuck", "surprising", "on probation"];

impl SensorTrouble {
    /// How often that was the reason; none where it never was.
    pub fn count(&self, reason: &str) -> Option<u16> {
        self.reasons.iter().find(|(name, _)| *name == reason).map(|(_, count)| *count)
    }

    /// The same in words: counts stop at their greatest value.
    pub fn counted(&self, reason: &str) -> Option<String> {
        let or_more = |count: u16| if count == u16::MAX { " or more" } else { "" };
        self.count(reason).map(|count| format!("{count}{}", or_more(count)))
    }
}

/// Every sensor that gave trouble.
pub fn troubles(health: &EstimatorHealth) -> Vec<SensorTrouble> {
    let named = health.sensors.zip_map(Sensor::all(), |health, sensor| (sensor, health));
    named
        .iter()
        .filter(|(_, health)| *health != SensorHealth::default())
        .map(|(sensor, health)| SensorTrouble {
            sensor: sensor_name(*sensor),
            reasons: reasons(*sensor, health),
            dropped: health.dropped,
        })
        .collect()
}

fn reasons(sensor: Sensor, health: &SensorHealth) -> Vec<(&'static str, u16)> {
    let SensorHealth { missing, not_finite, out_of_range, stuck, surprising, on_probation, dropped: _ } = *health;
    let counts = [missing, not_finite, out_of_range, stuck, surprising, on_probation];
    let is_used = |reason: &str| reason == "stuck" && matches!(sensor, Sensor::WheelRate(..));
    let named = REASONS.map(|reason| if is_used(reason) { REPEATS } else { reason });
    named.into_iter().zip(counts).filter(|(_, count)| *count > 0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_trouble_is_told() {
        let mut health = EstimatorHealth { frames: 9, ..EstimatorHealth::NOTHING };
        assert_eq!(troubles(&health), []);
        health.sensors.load_cell.right.middle.stuck = 4;
        health.sensors.load_cell.right.middle.dropped = true;
        let trouble = SensorTrouble { sensor: "load_cell_mr_n".to_owned(), reasons: vec![("stuck", 4)], dropped: true };
        assert_eq!(troubles(&health), [trouble]);
    }

    #[test]
    fn an_encoder_that_repeats_is_used() {
        let mut health = EstimatorHealth { frames: 1_000_000, ..EstimatorHealth::NOTHING };
        health.sensors.wheel_rate.left.front.stuck = u16::MAX;
        let [trouble] = &troubles(&health)[..] else { panic!("one sensor") };
        assert_eq!((trouble.count("stuck"), trouble.counted(REPEATS).as_deref()), (None, Some("65535 or more")));
    }
}
