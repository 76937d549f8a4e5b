//! Which columns of a campaign a force channel may follow.

use std::collections::HashMap;

use crate::data::campaign::{Campaign, Channel};
use crate::diagnose::measurements::KNOWN_SHARE;

/// A column that an effect makes a force channel follow.
#[derive(Debug, Clone, Copy)]
pub struct Source {
    /// The effect.
    pub id: &'static str,
    /// Its form.
    pub form: &'static str,
    /// The parameter that the form frees.
    pub parameter: &'static str,
    /// The column.
    pub channel: Channel,
    /// What the effect adds to the reading for a parameter of one.
    pub value: fn(f64) -> f64,
    /// As in [`Term`](super::regression::Term).
    pub by_instruments: bool,
}

/// The sources whose columns most rows have, and that vary.
pub fn available(campaign: &Campaign, sources: &'static [Source]) -> Vec<&'static Source> {
    let slips = varies(campaign, Channel::Slip);
    let usable = |source: &&Source| varies(campaign, source.channel) && (slips || !source.by_instruments);
    sources.iter().filter(usable).collect()
}

/// Whether most rows have a channel, and it is not the same in all; gross errors aside.
pub fn varies(campaign: &Campaign, channel: Channel) -> bool {
    let sound: Vec<usize> = campaign.sound_rows().collect();
    let values: Vec<f64> = sound.iter().filter_map(|row| campaign.value(*row, channel)).collect();
    let first = values.first().copied().unwrap_or(0.0);
    values.len() as f64 >= KNOWN_SHARE * sound.len() as f64
        && values.iter().any(|value| (value - first).abs() > 1e-9 * first.abs())
}

/// The rows that have all of these channels, but for those with a gross error: one would hide what all others show.
pub fn complete_rows(campaign: &Campaign, needed: &[Channel]) -> Vec<usize> {
    let has_all = |row: &usize| needed.iter().all(|channel| campaign.value(*row, *channel).is_some());
    campaign.sound_rows().filter(has_all).collect()
}

/// The number of each row's run.
pub fn run_numbers(campaign: &Campaign) -> Vec<usize> {
    let mut numbers = HashMap::new();
    let number = |row: &crate::data::campaign::RowId| {
        let next = numbers.len();
        *numbers.entry(row.run.clone()).or_insert(next)
    };
    campaign.rows().iter().map(number).collect()
}
