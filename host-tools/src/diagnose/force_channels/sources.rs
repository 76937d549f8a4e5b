//! Which columns of a campaign a force channel may follow.

use std::collections::HashMap;

use crate::data::campaign::{Campaign, Channel, RowId};
use crate::diagnose::lone_rows::LoneRow;
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

/// The rows of a campaign in which its sensors count.
#[derive(Debug)]
pub struct SensorRows<'a> {
    campaign: &'a Campaign,
    rows: Vec<usize>,
}

impl<'a> SensorRows<'a> {
    /// All but those with a gross error, which would hide what all others show, copies of other rows, and those that are set aside.
    pub fn of(campaign: &'a Campaign, set_aside: &[LoneRow]) -> Self {
        let copies = campaign.copies();
        let counts = |row: &usize| !copies[*row] && set_aside.iter().all(|lone| lone.place != *row);
        Self { campaign, rows: campaign.sound_rows().filter(counts).collect() }
    }

    /// The campaign.
    pub fn campaign(&self) -> &'a Campaign {
        self.campaign
    }

    /// The sources whose columns most rows have, and that vary.
    pub fn available(&self, sources: &'static [Source]) -> Vec<&'static Source> {
        let slips = self.varies(Channel::Slip);
        let usable = |source: &&Source| self.varies(source.channel) && (slips || !source.by_instruments);
        sources.iter().filter(usable).collect()
    }

    /// Whether most rows have a channel, and it is not the same in all.
    pub fn varies(&self, channel: Channel) -> bool {
        let values: Vec<f64> = self.rows.iter().filter_map(|row| self.campaign.value(*row, channel)).collect();
        let first = values.first().copied().unwrap_or(0.0);
        values.len() as f64 >= KNOWN_SHARE * self.rows.len() as f64
            && values.iter().any(|value| (value - first).abs() > 1e-9 * first.abs())
    }

    /// The rows that have all of these channels, by their places in the campaign.
    pub fn complete(&self, needed: &[Channel]) -> Vec<usize> {
        let has_all = |row: &&usize| needed.iter().all(|channel| self.campaign.value(**row, *channel).is_some());
        self.rows.iter().filter(has_all).copied().collect()
    }

    /// The number of each row's run, of all rows of the campaign.
    pub fn run_numbers(&self) -> Vec<usize> {
        let mut numbers = HashMap::new();
        let number = |row: &'a RowId| {
            let next = numbers.len();
            *numbers.entry(row.run.as_str()).or_insert(next)
        };
        self.campaign.rows().iter().map(number).collect()
    }
}
