//! `[noise]`: what is stated about the sensors.

use std::collections::BTreeMap;

use toml::Spanned;

use crate::error::HostError;

use super::super::toml_file::TomlFile;
use super::Channel;

/// One standard deviation of the channels for which one is stated, in the channel's unit.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ChannelNoise(BTreeMap<String, f64>);

impl ChannelNoise {
    /// # Errors
    /// At a deviation that is negative or not finite, or one of a channel that neither the format nor the table knows.
    pub(super) fn read(
        stated: &BTreeMap<Spanned<String>, Spanned<f64>>,
        file: &TomlFile,
        columns: &[&str],
    ) -> Result<Self, HostError> {
        let mut noise = BTreeMap::new();
        for (name, std) in stated {
            if Channel::from_name(name.get_ref()).is_none() && !columns.contains(&name.get_ref().as_str()) {
                let message = format!("no channel `{}`: expected the name of a column of numbers", name.get_ref());
                return Err(file.error_at(name, message));
            }
            let value = *std.get_ref();
            if !(value >= 0.0 && value.is_finite()) {
                let message = format!("{} = {value}: expected a standard deviation of 0 or more", name.get_ref());
                return Err(file.error_at(std, message));
            }
            noise.insert(name.get_ref().clone(), value);
        }
        Ok(Self(noise))
    }

    /// One standard deviation of a channel, where it is stated.
    pub fn of(&self, channel: Channel) -> Option<f64> {
        self.of_column(channel.name())
    }

    /// One standard deviation of any column, where it is stated.
    pub fn of_column(&self, name: &str) -> Option<f64> {
        self.0.get(name).copied()
    }
}
