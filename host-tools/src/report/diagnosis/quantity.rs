//! Channels, columns and soil parameters in the words and units that people read.

use crate::data::campaign::Channel;

/// Something measured or fitted, as it is shown.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// Its name.
    pub name: String,
    /// The unit in which it is shown; empty where it has none.
    pub unit: &'static str,
    /// From the unit of the file to the shown one.
    pub factor: f64,
}

impl Quantity {
    fn new(name: &str, unit: &'static str, factor: f64) -> Self {
        Self { name: name.to_owned(), unit, factor }
    }

    /// A column of a campaign; one that the format does not know keeps its own name and unit. Also a product of columns,
    /// `slip*sinkage_m`.
    pub fn of_column(name: &str) -> Self {
        if name.contains('*') {
            let factors: Vec<String> = name.split('*').map(|factor| Self::of_column(factor.trim()).name).collect();
            return Self::new(&factors.join(" × "), "SI", 1.0);
        }
        let degrees = 180.0 / std::f64::consts::PI;
        let (words, unit, factor) = match Channel::from_name(name) {
            Some(Channel::Time) => ("Time", "s", 1.0),
            Some(Channel::Slip) => ("Slip", "", 1.0),
            Some(Channel::Load) => ("Load", "N", 1.0),
            Some(Channel::DrawbarPull) => ("Drawbar pull", "N", 1.0),
            Some(Channel::Torque) => ("Torque", "N·m", 1.0),
            Some(Channel::Sinkage) => ("Sinkage", "mm", 1e3),
            Some(Channel::SideForce) => ("Side force", "N", 1.0),
            Some(Channel::SlipAngle) => ("Slip angle", "°", degrees),
            Some(Channel::WheelRate) => ("Wheel rate", "rad/s", 1.0),
            Some(Channel::Speed) => ("Speed", "mm/s", 1e3),
            Some(Channel::WheelAngle) => ("Wheel angle", "°", degrees),
            Some(Channel::Pass) => ("Pass", "", 1.0),
            Some(Channel::Temperature) => ("Temperature", "°C", 1.0),
            Some(Channel::HoursSinceZero) => ("Time since the sensors were zeroed", "h", 1.0),
            Some(Channel::Travel) => ("Travel", "m", 1.0),
            Some(Channel::Pitch) => ("Pitch", "°", degrees),
            None => (name, "", 1.0),
        };
        Self::new(words, unit, factor)
    }

    /// A parameter of the soil, by its key in `[soil]`.
    pub fn of_soil(key: &str) -> Self {
        match key {
            "n" => Self::new("Sinkage exponent n", "", 1.0),
            "k_c" => Self::new("Cohesive modulus k_c", "kPa/m^(n−1)", 1e-3),
            "k_phi" => Self::new("Frictional modulus k_φ", "MPa/m^n", 1e-6),
            "k_eff" => Self::new("Stiffness k_c/b + k_φ", "MPa/m^n", 1e-6),
            "c" => Self::new("Cohesion c", "Pa", 1.0),
            "phi" => Self::new("Friction angle φ", "°", 180.0 / std::f64::consts::PI),
            "K" => Self::new("Shear modulus K", "mm", 1e3),
            "c1" => Self::new("Position of the peak stress c₁", "", 1.0),
            "c2" => Self::new("Shift of the peak stress c₂", "", 1.0),
            "eta" => Self::new("Rebound ratio η", "", 1.0),
            other => Self::new(other, "", 1.0),
        }
    }

    /// Its name with its unit, for an axis or a row of a table.
    pub fn titled(&self) -> String {
        if self.unit.is_empty() { self.name.clone() } else { format!("{}, {}", self.name, self.unit) }
    }
}

/// The keys of `[soil]` in the order in which they are shown.
pub const SOIL_KEYS: [&str; 10] = ["n", "k_eff", "k_phi", "k_c", "c", "phi", "K", "c1", "c2", "eta"];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_column_of_the_format_has_words() {
        for channel in Channel::ALL {
            assert_ne!(Quantity::of_column(channel.name()).name, channel.name());
        }
        assert_eq!(Quantity::of_column("slip*sinkage_m").name, "Slip × Sinkage");
        assert_eq!(Quantity::of_column("moisture").titled(), "moisture");
        for key in SOIL_KEYS {
            assert!(Quantity::of_soil(key).name.len() > key.len());
        }
    }
}
