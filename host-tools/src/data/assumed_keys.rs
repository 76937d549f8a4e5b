//! What a rover file leaves out, and is taken from the assumed set K0.

use std::fmt;

/// The keys that a rover file lacks.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct AssumedKeys {
    /// In the order of the format: a table that lacks all of its keys by itself.
    absent: Vec<String>,
    is_all: bool,
}

impl AssumedKeys {
    /// Of all keys, as `key` or `table.key` in the order of the format, with whether each is absent.
    pub fn of(keys: &[(&str, bool)]) -> Self {
        let of_one_table = keys.chunk_by(|(one, _), (other, _)| table(one).is_some() && table(one) == table(other));
        let absent = of_one_table.flat_map(|keys| match keys.first().and_then(|(key, _)| table(key)) {
            Some(table) if keys.iter().all(|(_, is_absent)| *is_absent) => vec![format!("[{table}]")],
            _ => keys.iter().filter(|(_, is_absent)| *is_absent).map(|(key, _)| (*key).to_owned()).collect(),
        });
        Self { absent: absent.collect(), is_all: keys.iter().all(|(_, is_absent)| *is_absent) }
    }

    /// Whether the file says everything.
    pub fn are_none(&self) -> bool {
        self.absent.is_empty()
    }

    /// Whether it says nothing, or there is none.
    pub fn are_all(&self) -> bool {
        self.is_all
    }
}

fn table(key: &str) -> Option<&str> {
    key.split_once('.').map(|(table, _)| table)
}

impl fmt::Display for AssumedKeys {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.absent.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::AssumedKeys;

    #[test]
    fn a_table_that_is_absent_is_named_once() {
        let keys =
            ["mass_kg", "gravity_m_s2", "wheel.radius_m", "wheel.width_m", "noise.angle_rad", "noise.gyro_rad_s"];
        let without = |absent: &[&str]| AssumedKeys::of(&keys.map(|key| (key, absent.contains(&key))));
        assert!(without(&[]).are_none() && !without(&[]).are_all());
        assert!(without(&keys).are_all() && !without(&keys).are_none());
        assert_eq!(without(&keys).to_string(), "mass_kg, gravity_m_s2, [wheel], [noise]");
        let some = without(&["gravity_m_s2", "wheel.width_m", "noise.angle_rad", "noise.gyro_rad_s"]);
        assert_eq!(some.to_string(), "gravity_m_s2, wheel.width_m, [noise]");
        assert!(!some.are_all() && !some.are_none());
    }
}
