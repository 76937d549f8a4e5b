//! Sensors nearly all of whose readings are farther out than a rover can be: those of another unit, as degrees in a column of rad.

use kapvik_firmware::estimator::{EstimatorHealth, Sensor, SensorHealth};

use crate::data::sensor_channels::sensor_name;

/// Fewest readings that tell, and the share of all that has to be out of range.
const LEAST_READINGS: u16 = 50;
const MOST: f64 = 0.9;

/// What the filters' counts tell of them, without capital and stop.
pub fn told(health: &EstimatorHealth) -> Option<String> {
    // Counts of readings stop at their greatest value: then they say no more how many of all it is, but the sensor is out of use.
    let counted = u16::try_from(health.frames);
    let is_beyond = |sensor: &SensorHealth| {
        let spoken = counted.unwrap_or(u16::MAX).saturating_sub(sensor.missing);
        let is_most = f64::from(sensor.out_of_range) >= MOST * f64::from(spoken);
        sensor.out_of_range >= LEAST_READINGS && is_most && (counted.is_ok() || sensor.dropped)
    };
    let named = health.sensors.zip_map(Sensor::all(), |health, sensor| (sensor, health));
    let beyond: Vec<String> =
        named.iter().filter(|(_, health)| is_beyond(health)).map(|(sensor, _)| sensor_name(*sensor)).collect();
    let [says, then] = match beyond.len() {
        1 => ["says", "it speaks in other units than its name says, or is broken, and is"],
        _ => ["say", "they speak in other units than their names say, or are broken, and are"],
    };
    let columns = beyond.join(", ");
    (!beyond.is_empty())
        .then(|| format!("{columns} {says} more than a rover can do in nearly all readings: {then} done without"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told_of(frames: u32, sensor: SensorHealth) -> Option<String> {
        let mut health = EstimatorHealth { frames, ..EstimatorHealth::NOTHING };
        health.sensors.bogie_angle.left = sensor;
        told(&health)
    }

    fn of(frames: u32, out_of_range: u16) -> Option<String> {
        told_of(frames, SensorHealth { out_of_range, dropped: true, ..SensorHealth::default() })
    }

    #[test]
    fn a_sensor_that_is_hardly_ever_in_range_is_named() {
        let said = of(400, 390).expect("in degrees");
        assert!(
            said.starts_with("bogie_angle_l_rad says more than a rover can do in nearly all readings: it speaks"),
            "{said}"
        );
        assert!(of(1_000_000, u16::MAX).is_some(), "as often as can be counted");
        assert_eq!([of(400, 100), of(40, 40), of(1_000_000, 30_000)], [None, None, None]);
        let glitches = SensorHealth { out_of_range: u16::MAX, ..SensorHealth::default() };
        assert_eq!(told_of(1_000_000, glitches), None, "one in fifteen, and the others are in use");
    }

    #[test]
    fn a_sensor_that_seldom_speaks_is_named_by_its_readings() {
        let seldom = |out_of_range| SensorHealth { out_of_range, missing: 3800, ..SensorHealth::default() };
        assert!(told_of(4000, seldom(195)).is_some());
        assert_eq!([told_of(4000, seldom(100)), told_of(4000, seldom(45))], [None, None]);
    }
}
