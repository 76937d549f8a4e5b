//! Names that are nearly another.

use strsim::{jaro_winkler, normalized_damerau_levenshtein};

use super::number_stream::NumberStream;
use super::time_column::TIME;
use crate::error::HostError;

/// From this likeness of two keys on, of 1, one is taken for a misspelling of the other.
const KEYS: f64 = 0.85;
/// The same of two columns, which are many and differ in a letter.
const COLUMNS: f64 = 0.8;
/// What the columns end with; longer ones first.
const UNITS: [&str; 8] = ["_rad_s", "_m_s2", "_m_s", "_rad", "_nm", "_n", "_m", "_c"];

/// The one of these keys of a TOML file that a key is most like, where it may be a misspelling of it.
pub fn key_meant(name: &str, names: &[&'static str]) -> Option<&'static str> {
    most_like(names.iter().map(|other| (*other, jaro_winkler(name, other))).filter(|(_, likeness)| *likeness >= KEYS))
}

/// The one of these columns that a column is most like, where it may be a misspelling of it or the same in another unit.
pub fn column_meant<'a>(name: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let name = name.to_lowercase();
    let is_same_quantity = |other: &str| {
        let quantity = UNITS.iter().find_map(|unit| other.strip_suffix(unit)).unwrap_or(other);
        name.strip_prefix(quantity).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
    };
    let alike = names.into_iter().map(|other| (other, normalized_damerau_levenshtein(&name, other)));
    most_like(alike.filter(|(other, likeness)| *likeness >= COLUMNS || is_same_quantity(other)))
}

/// The columns of a table that are neither the time nor one of these, and their places.
pub fn other_columns<'a>(stream: &'a NumberStream, names: &'a [String]) -> impl Iterator<Item = (usize, &'a String)> {
    stream.header().iter().enumerate().filter(move |(_, name)| *name != TIME && !names.contains(name))
}

/// Refuses a table in whose header one of these columns is missing for the sake of a letter or a unit: a sensor would be absent. `what`
/// says what such a column is.
pub fn refuse_misspelt(stream: &NumberStream, names: &[String], what: &str) -> Result<(), HostError> {
    let absent = || names.iter().filter(|name| !stream.header().contains(name)).map(String::as_str);
    for (place, name) in other_columns(stream, names) {
        if let Some(meant) = column_meant(name, absent()) {
            return Err(stream.error_in_header(place as u64 + 1, format!("`{name}` is no {what}: is `{meant}` meant?")));
        }
    }
    Ok(())
}

fn most_like<'a>(alike: impl Iterator<Item = (&'a str, f64)>) -> Option<&'a str> {
    alike.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(name, _)| name)
}

#[cfg(test)]
mod tests {
    use super::{column_meant, key_meant};

    #[test]
    fn other_units_letters_and_cases_are_told_from_other_columns() {
        let sensors = ["load_cell_fl_n", "load_cell_ml_n", "wheel_rate_ml_rad_s", "accel_x_m_s2", "motor_torque_fl_nm"];
        let meant = |name| column_meant(name, sensors);
        assert_eq!(meant("load_cell_fl"), Some("load_cell_fl_n"));
        assert_eq!(meant("load_cell_ml_kn"), Some("load_cell_ml_n"));
        assert_eq!(meant("wheel_rate_ml_rpm"), Some("wheel_rate_ml_rad_s"));
        assert_eq!(meant("Accel_X_m_s2"), Some("accel_x_m_s2"));
        assert_eq!(meant("acel_x_m_s2"), Some("accel_x_m_s2"));
        for other in ["motor_temperature_fl_c", "battery_v", "sun_angle_rad", "frame"] {
            assert_eq!(meant(other), None, "{other}");
        }
        assert_eq!(key_meant("gravity_ms2", &["mass_kg", "gravity_m_s2"]), Some("gravity_m_s2"));
    }
}
