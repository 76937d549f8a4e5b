//! Whether held-out errors are larger than noise allows.

use std::collections::BTreeMap;

use crate::data::campaign::{Campaign, Channel};

use super::chance::of_known_noise;
use super::document::ChannelErrors;
use super::fit::Reading;
use super::held_out_errors::HeldOutErrors;
use super::measurements::column_name;

/// Times what the stated noise allows from which errors on held-out runs are not that noise, and the chance below which they are not, where
/// each run tells as much as one reading: what the others say of the soil is off by the same in all of its rows.
const BEYOND_NOISE: f64 = 1.5;
const CHANCE: f64 = 1e-3;

/// The channel of stated noise that is missed by most of what noise allows on held-out runs, and by how many times that, where it is beyond
/// chance. None where no load is measured: what stands in for it has a noise of its own.
pub fn beyond_noise(
    campaign: &Campaign,
    channels: &BTreeMap<String, ChannelErrors>,
    errors: &HeldOutErrors,
) -> Option<(&'static str, f64)> {
    campaign.column(Channel::Load.name())?.iter().flatten().next()?;
    let missed = Reading::JUDGED.into_iter().filter_map(|reading| {
        let channel = column_name(reading);
        let of_channel = channels.get(channel).filter(|of_channel| of_channel.noise_stated)?;
        let (runs, times) = (of_channel.runs as f64, errors.times_expected(reading.index())?);
        let is_beyond = times > BEYOND_NOISE && of_known_noise(runs * times * times, runs) < CHANCE;
        is_beyond.then_some((channel, times))
    });
    missed.max_by(|a, b| a.1.total_cmp(&b.1))
}
