//! Sensors nearly all of whose readings are farther out than a rover can be: those of another unit, as degrees in a column of rad.

use kapvik_firmware::estimator::{PerSensor, Sensor};

use super::admitted::Spoken;
use super::raw_sensors::{LEAST_READINGS, NEARLY_ALL};
use crate::data::sensor_channels::sensor_name;

/// What comes of how often sensors spoke, without capital and stop.
pub fn told(spoken: &PerSensor<Spoken>) -> Option<String> {
    let named = spoken.zip_map(Sensor::all(), |spoken, sensor| (sensor, spoken));
    let beyond: Vec<String> =
        named.iter().filter(|(_, spoken)| spoken.is_beyond()).map(|(sensor, _)| sensor_name(*sensor)).collect();
    let [says, then] = match beyond.len() {
        1 => ["says", "it speaks in other units than its name says, or is broken, and is"],
        _ => ["say", "they speak in other units than their names say, or are broken, and are"],
    };
    let columns = beyond.join(", ");
    (!beyond.is_empty())
        .then(|| format!("{columns} {says} more than a rover can do in nearly all readings: {then} done without"))
}

impl Spoken {
    fn is_beyond(&self) -> bool {
        self.beyond >= LEAST_READINGS.into() && self.beyond as f64 >= NEARLY_ALL * self.readings as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(readings: u64, beyond: u64) -> Option<String> {
        let mut spoken = PerSensor::default();
        spoken.bogie_angle.left = Spoken { readings, beyond };
        told(&spoken)
    }

    #[test]
    fn a_sensor_that_is_hardly_ever_in_range_is_named() {
        let said = of(400, 390).expect("in degrees");
        assert!(
            said.starts_with("bogie_angle_l_rad says more than a rover can do in nearly all readings: it speaks"),
            "{said}"
        );
        assert!(of(1_000_000, 990_000).is_some());
        for (readings, beyond) in [(400, 100), (40, 40), (1_000_000, 30_000), (1_000_000, 65_535)] {
            assert_eq!(of(readings, beyond), None, "{beyond} of {readings}");
        }
    }

    #[test]
    fn a_sensor_that_seldom_speaks_is_named_by_its_readings() {
        assert!(of(200, 195).is_some());
        assert_eq!([of(200, 100), of(200, 45), of(0, 0)], [None, None, None]);
    }
}
