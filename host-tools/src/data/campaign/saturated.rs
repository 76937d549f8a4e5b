//! Readings at an end of a sensor's range: many that are one and the same number, which no other goes beyond. The wheel felt that or more.

use std::collections::HashMap;

use super::{Channel, Measured, RowId};

/// What sensors read of a wheel whose slip and load are set.
const READ: [Channel; 4] = [Channel::DrawbarPull, Channel::Torque, Channel::Sinkage, Channel::SideForce];
/// Fewest readings, and least share of a channel's, that are an end.
const FEWEST: usize = 5;
const SHARE: f64 = 0.05;
/// Times as often as any number between the ends comes: a channel of few digits repeats them all.
const TIMES: usize = 4;
/// Fewest other numbers in the channel.
const OTHERS: usize = 5;

/// An end of a channel's range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct End {
    channel: Channel,
    value: f64,
    is_greatest: bool,
    readings: usize,
    all: usize,
}

impl End {
    /// What is said of it.
    pub fn in_words(&self) -> String {
        let Self { channel, value, is_greatest, readings, all } = self;
        format!(
            "{} reads exactly {value} in {readings} of {all} rows and never {}: taken for the end of its range and left out there.",
            channel.name(),
            if *is_greatest { "more" } else { "less" }
        )
    }
}

/// Takes readings at the ends of their channels' ranges for none, and tells which ends these are. The rows stay.
pub(super) fn take_out(rows: &[RowId], columns: &mut [Measured]) -> Vec<End> {
    let mut found = Vec::new();
    for channel in READ {
        let Some(column) = columns.iter_mut().find(|column| column.name == channel.name()) else { continue };
        let ends = ends(channel, &column.values, &at_first_zero(channel, rows, &column.values));
        for value in &mut column.values {
            *value = value.filter(|value| ends.iter().all(|end| end.value != *value));
        }
        found.extend(ends);
    }
    found
}

/// Of each row whether its run, from its beginning up to there, has a sinkage of nothing: there the gauge was zeroed.
fn at_first_zero(channel: Channel, rows: &[RowId], values: &[Option<f64>]) -> Vec<bool> {
    let mut begins: Vec<bool> = Vec::with_capacity(rows.len());
    for (row, id) in rows.iter().enumerate() {
        let is_first = row == 0 || rows[row - 1].run != id.run;
        let is_zero = channel == Channel::Sinkage && values[row] == Some(0.0);
        begins.push(is_zero && (is_first || begins[row - 1]));
    }
    begins
}

/// The ends of a channel's range that it was at.
fn ends(channel: Channel, values: &[Option<f64>], but: &[bool]) -> Vec<End> {
    let mut times: HashMap<u64, usize> = HashMap::new();
    for value in values.iter().zip(but).filter(|(_, but)| !**but).filter_map(|(value, _)| *value) {
        // Zero is one number, of whichever sign.
        *times.entry((value + 0.0).to_bits()).or_default() += 1;
    }
    let Some((least, greatest)) = crate::statistics::ends(times.keys().map(|bits| f64::from_bits(*bits))) else {
        return Vec::new();
    };
    let all: usize = times.values().sum();
    let between = times.iter().filter(|(bits, _)| ![least, greatest].contains(&f64::from_bits(**bits)));
    let often = TIMES * between.map(|(_, times)| *times).max().unwrap_or(0);
    let end = |(value, is_greatest): (f64, bool)| {
        let readings = times[&(value + 0.0).to_bits()];
        let is_end = readings >= FEWEST.max(often) && readings as f64 >= SHARE * all as f64 && times.len() > OTHERS;
        is_end.then_some(End { channel, value, is_greatest, readings, all })
    };
    [(greatest, true), (least, false)].into_iter().filter_map(end).collect()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::Campaign;
    use super::*;

    /// A campaign of one run, and of its remarks those on ends.
    fn read(torques_nm: impl Iterator<Item = f64>, sinkages_m: impl Iterator<Item = f64>) -> (Campaign, Vec<String>) {
        let row = |(row, (torque, sinkage)): (usize, (f64, f64))| {
            format!("a,{row},{},{},{torque},{sinkage}\n", 0.005 * row as f64, 80.0 + 0.1 * row as f64)
        };
        let rows: String = torques_nm.zip(sinkages_m).enumerate().map(row).collect();
        let csv = format!("run,t_s,slip,load_n,torque_nm,sinkage_m\n{rows}");
        let toml = "name = \"a\"\nkind = \"measured\"\n[wheel]\nradius_m = 0.15\nwidth_m = 0.1\n";
        let campaign = Campaign::parse(Path::new("a.csv"), &csv, toml).expect("a campaign");
        let remarks = campaign.remarks();
        (campaign, remarks)
    }

    fn rising(count: usize) -> impl Iterator<Item = f64> {
        (0..count).map(|row| 0.01 + 1e-4 * row as f64)
    }

    #[test]
    fn a_torque_that_stays_at_its_greatest_is_left_out_there_and_told() {
        let torque = |row: usize| (0.5 + 0.05 * row as f64).min(2.0);
        let (campaign, said) = read((0..40).map(torque), rising(40));
        assert_eq!(
            said,
            [
                "torque_nm reads exactly 2 in 10 of 40 rows and never more: taken for the end of its range and left out there."
            ]
        );
        assert_eq!(campaign.rows().len(), 40);
        let left = |row| campaign.value(row, Channel::Torque);
        assert_eq!([29, 30, 39].map(left), [Some(torque(29)), None, None]);
        assert!((0..40).all(|row| campaign.value(row, Channel::Sinkage).is_some()));
    }

    /// The least end of a sinkage is where its gauge leaves the ground; what a run begins with is where it was zeroed.
    #[test]
    fn a_sinkage_of_nothing_is_an_end_but_where_a_run_begins() {
        let torques = || (0..40).map(|row| 1.0 + 0.01 * f64::from(row));
        let within = |row: usize| if row % 5 == 3 { 0.0 } else { 0.01 + 1e-4 * row as f64 };
        let (_, said) = read(torques(), (0..40).map(within));
        assert!(said[0].starts_with("sinkage_m reads exactly 0 in 8 of 40 rows and never less"), "{said:?}");
        let (campaign, said) = read(torques(), [0.0; 8].into_iter().chain(rising(32)));
        assert_eq!((campaign.value(0, Channel::Sinkage), said), (Some(0.0), vec![]));
    }

    /// Tenths repeat all over the range, and a few readings are none.
    #[test]
    fn few_digits_and_few_readings_are_no_end() {
        let tenths = |row: usize| (20.0 * (0.1 * row as f64).sin()).round() / 10.0;
        let (_, said) = read((0..120).map(|row| 3.0 + tenths(row)), rising(120));
        assert!(said.is_empty(), "{said:?}");
        let (_, said) = read((0..40).map(|row| f64::from(row).min(36.0) / 20.0), rising(40));
        assert!(said.is_empty(), "{said:?}");
    }
}
