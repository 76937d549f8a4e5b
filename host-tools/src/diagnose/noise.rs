//! How noisy the readings of a campaign are.

use crate::data::campaign::Campaign;

use super::fit::{CHANNELS, Reading};
use super::measurements::{COLUMNS, median};
use crate::statistics::sorted;

/// Noise of a channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// One standard deviation, in the channel's unit; where it is not stated, a first guess.
    pub std: f64,
    /// Whether the campaign states it.
    pub stated: bool,
}

/// Slip of a campaign that does not say how well it is known.
const SLIP_STD: f64 = 0.002;
/// Load over its middle value, likewise.
const LOAD_SHARE: f64 = 0.005;
/// Fewest rows with one before and one after from which scatter is known.
const LEAST_BENDS: usize = 8;
/// Rows alike in slip.
const LIKE_SLIP: f64 = 0.01;
/// Rows alike in load, as a share of it.
const LIKE_LOAD: f64 = 0.05;

/// The noise of every reading of some rows: as stated, or guessed from rows that are alike in slip and load. A fit estimates
/// those that are guessed.
pub fn channel_noise(campaign: &Campaign, rows: &[(usize, [Option<f64>; CHANNELS])]) -> [Noise; CHANNELS] {
    Reading::ALL.map(|reading| {
        let channel = COLUMNS[reading.index()];
        let values = || rows.iter().filter_map(|(_, readings)| readings[reading.index()]).collect::<Vec<_>>();
        match campaign.noise.of(channel) {
            Some(std) if std > 0.0 => Noise { std, stated: true },
            _ => Noise { std: guess(campaign, reading, rows).max(1e-9 + 1e-4 * spread(values())), stated: false },
        }
    })
}

fn guess(campaign: &Campaign, reading: Reading, rows: &[(usize, [Option<f64>; CHANNELS])]) -> f64 {
    let values = || rows.iter().filter_map(|(_, readings)| readings[reading.index()]).collect::<Vec<_>>();
    let at_most = |std: f64| within_runs(campaign, reading, rows).map_or(std, |scatter| std.min(scatter));
    match reading {
        Reading::Slip => at_most(SLIP_STD),
        Reading::Load => at_most(LOAD_SHARE * median(values()).unwrap_or(0.0).abs()),
        _ => from_like_rows(reading, rows).unwrap_or(0.1 * spread(values())),
    }
}

/// Half of the range that holds the middle four fifths.
fn spread(values: Vec<f64>) -> f64 {
    let values = sorted(values);
    let at = |share: f64| values.get((share * values.len() as f64) as usize).copied().unwrap_or(0.0);
    0.5 * (at(0.9) - at(0.1)).abs()
}

/// From the middle size of how far a reading is from the mean of those before and after it in its run: white noise, and how it bends. None
/// where there are few, or most are the same number: it was set, and nothing read it.
fn within_runs(campaign: &Campaign, reading: Reading, rows: &[(usize, [Option<f64>; CHANNELS])]) -> Option<f64> {
    let bend = |three: &[(usize, [Option<f64>; CHANNELS])]| {
        let [(before, _), (at, _), (after, _)] = three else { return None };
        let runs = [before, at, after].map(|row| &campaign.rows()[*row].run);
        let [before, at, after] = [three[0].1, three[1].1, three[2].1].map(|readings| readings[reading.index()]);
        (runs[0] == runs[1] && runs[1] == runs[2]).then_some((before? - 2.0 * at? + after?).abs())
    };
    let sizes: Vec<f64> = rows.windows(3).filter_map(bend).collect();
    // The median of |N(0, 6σ²)| is 0.6745 √6 σ.
    let std = (sizes.len() >= LEAST_BENDS).then(|| median(sizes).unwrap_or(0.0) / (0.6745 * f64::sqrt(6.0)));
    std.filter(|std| *std > 0.0)
}

/// From the middle size of the differences between rows that follow each other in slip and are alike.
fn from_like_rows(reading: Reading, rows: &[(usize, [Option<f64>; CHANNELS])]) -> Option<f64> {
    let at = |readings: &[Option<f64>; CHANNELS], reading: Reading| readings[reading.index()];
    let mut known: Vec<_> = rows
        .iter()
        .filter_map(|(_, row)| {
            Some((at(row, Reading::Slip)?, at(row, Reading::Load).unwrap_or(0.0), at(row, reading)?))
        })
        .collect();
    known.sort_by(|a, b| a.0.total_cmp(&b.0));
    let like = |a: &(f64, f64, f64), b: &(f64, f64, f64)| {
        (b.0 - a.0).abs() <= LIKE_SLIP && (b.1 - a.1).abs() <= LIKE_LOAD * a.1.abs()
    };
    let pairs = known.windows(2).filter(|pair| like(&pair[0], &pair[1]));
    let sizes: Vec<f64> = pairs.map(|pair| (pair[1].2 - pair[0].2).abs()).collect();
    // The median of |N(0, 2σ²)| is 0.6745 √2 σ.
    (sizes.len() >= 3)
        .then(|| median(sizes).unwrap_or(0.0) / (0.6745 * std::f64::consts::SQRT_2))
        .filter(|std| *std > 0.0)
}
