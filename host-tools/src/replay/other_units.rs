//! Sensors nearly all of whose readings are farther out than a rover can be: those of another unit, as degrees in a column of rad.

use kapvik_firmware::estimator::{EstimatorHealth, Sensor};

use crate::data::sensor_channels::sensor_name;

/// Fewest frames that tell, and the share of them that has to be out of range.
const LEAST_FRAMES: u16 = 50;
const MOST: f64 = 0.9;

/// What the filters' counts tell of them, without capital and stop.
pub fn told(health: &EstimatorHealth) -> Option<String> {
    // Counts of readings stop at their greatest value.
    let frames = u16::try_from(health.frames).unwrap_or(u16::MAX);
    let is_beyond = |count: u16| frames >= LEAST_FRAMES && f64::from(count) >= MOST * f64::from(frames);
    let named = health.sensors.zip_map(Sensor::all(), |health, sensor| (sensor, health));
    let beyond: Vec<String> = named
        .iter()
        .filter(|(_, health)| is_beyond(health.out_of_range))
        .map(|(sensor, _)| sensor_name(*sensor))
        .collect();
    let [says, then] = match beyond.len() {
        1 => ["says", "it speaks in other units than its name says, or is broken, and is"],
        _ => ["say", "they speak in other units than their names say, or are broken, and are"],
    };
    let columns = beyond.join(", ");
    (!beyond.is_empty())
        .then(|| format!("{columns} {says} more than a rover can do in nearly all frames: {then} done without"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(frames: u32, out_of_range: u16) -> Option<String> {
        let mut health = EstimatorHealth { frames, ..EstimatorHealth::NOTHING };
        health.sensors.bogie_angle.left.out_of_range = out_of_range;
        told(&health)
    }

    #[test]
    fn a_sensor_that_is_hardly_ever_in_range_is_named() {
        let said = of(400, 390).expect("in degrees");
        assert!(
            said.starts_with("bogie_angle_l_rad says more than a rover can do in nearly all frames: it speaks"),
            "{said}"
        );
        assert!(of(1_000_000, u16::MAX).is_some(), "as often as can be counted");
        assert_eq!([of(400, 100), of(40, 40), of(1_000_000, 30_000)], [None, None, None]);
    }
}
