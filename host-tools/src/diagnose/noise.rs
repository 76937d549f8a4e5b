//! How noisy the readings of a campaign are.

use crate::data::campaign::Campaign;
use crate::data::campaign::like_rows::{Pairing, SlipAndLoad, like_pairs};

use super::fit::{CHANNELS, Reading};
use super::measurements::{COLUMNS, median};
use super::usable_rows::UsableRow;
use crate::statistics::{robust_std, sorted};

/// Noise of a channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// One standard deviation, in the channel's unit; where it is not stated, a first guess.
    pub std: f64,
    /// Whether the campaign states it.
    pub stated: bool,
    /// Where it is not stated, what runs that repeat each other scatter by, whatever a model makes of them; none where few do.
    pub of_repeats: Option<f64>,
}

/// Slip of a campaign that does not say how well it is known, at most.
pub const SLIP_STD: f64 = 0.002;
/// Load over its middle value, likewise.
const LOAD_SHARE: f64 = 0.005;
/// Fewest rows with one before and one after from which scatter is known.
const LEAST_BENDS: usize = 8;
/// Fewest pairs of like rows from which a first guess is made.
const LEAST_LIKE: usize = 3;
/// Fewest pairs of like rows of two runs from which noise is known.
const LEAST_REPEATS: usize = 8;
/// Rows alike in load, as a share of it.
const LIKE_LOAD: f64 = 0.05;

/// The noise of every reading of some rows: as stated, or guessed from rows that are alike in slip and load. A fit estimates
/// those that are guessed.
pub fn channel_noise(campaign: &Campaign, rows: &[UsableRow]) -> [Noise; CHANNELS] {
    Reading::ALL.map(|reading| {
        let channel = COLUMNS[reading.index()];
        let values = || rows.iter().filter_map(|row| row.readings[reading.index()]).collect::<Vec<_>>();
        match campaign.noise.of(channel) {
            Some(std) if std > 0.0 => Noise { std, stated: true, of_repeats: None },
            _ => Noise {
                std: guess(campaign, reading, rows).max(1e-9 + 1e-4 * spread(values())),
                stated: false,
                of_repeats: of_repeats(campaign, reading, rows),
            },
        }
    })
}

fn guess(campaign: &Campaign, reading: Reading, rows: &[UsableRow]) -> f64 {
    let values = || rows.iter().filter_map(|row| row.readings[reading.index()]).collect::<Vec<_>>();
    let at_most = |std: f64| within_runs(campaign, reading, rows).map_or(std, |scatter| std.min(scatter));
    match reading {
        Reading::Slip => at_most(SLIP_STD),
        Reading::Load => at_most(LOAD_SHARE * median(values()).unwrap_or(0.0).abs()),
        _ => from_like_rows(campaign, reading, rows).unwrap_or(0.1 * spread(values())),
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
pub fn within_runs(campaign: &Campaign, reading: Reading, rows: &[UsableRow]) -> Option<f64> {
    let bend = |three: &[UsableRow]| {
        let three: &[UsableRow; 3] = three.try_into().ok()?;
        let runs = three.map(|row| &campaign.rows()[row.place].run_in_file);
        let [before, at, after] = three.map(|row| row.readings[reading.index()]);
        (runs[0] == runs[1] && runs[1] == runs[2]).then_some(before? - 2.0 * at? + after?)
    };
    let bends: Vec<f64> = rows.windows(3).filter_map(bend).collect();
    // Their variance is 6σ².
    (bends.len() >= LEAST_BENDS).then(|| robust_std(bends) / f64::sqrt(6.0)).filter(|std| *std > 0.0)
}

/// From the middle size of the differences of like rows.
fn from_like_rows(campaign: &Campaign, reading: Reading, rows: &[UsableRow]) -> Option<f64> {
    of_differences(differences(campaign, reading, rows, |_, _| true), LEAST_LIKE)
}

/// The same of like rows of two runs.
fn of_repeats(campaign: &Campaign, reading: Reading, rows: &[UsableRow]) -> Option<f64> {
    let run = |row: usize| &campaign.rows()[row].run_in_file;
    of_differences(differences(campaign, reading, rows, |one, other| run(one) != run(other)), LEAST_REPEATS)
}

/// Differences have twice the variance of a reading.
fn of_differences(differences: Vec<f64>, least: usize) -> Option<f64> {
    let std = (differences.len() >= least).then(|| robust_std(differences) / std::f64::consts::SQRT_2);
    std.filter(|std| *std > 0.0)
}

/// By how much the readings of like rows that may be mates differ.
fn differences(
    campaign: &Campaign,
    reading: Reading,
    rows: &[UsableRow],
    may_be_mates: impl Fn(usize, usize) -> bool,
) -> Vec<f64> {
    let state = |row: &UsableRow| {
        let at = |reading: Reading| row.readings[reading.index()];
        at(reading)?;
        Some(SlipAndLoad { place: row.place, slip: at(Reading::Slip)?, load_n: at(Reading::Load).unwrap_or(0.0) })
    };
    let states = rows.iter().filter_map(state).collect();
    let value = |place: usize| campaign.value(place, COLUMNS[reading.index()]);
    let pairs = like_pairs(states, LIKE_LOAD, Pairing::Chained, may_be_mates);
    pairs.into_iter().filter_map(|[one, other]| Some(value(other)? - value(one)?)).collect()
}
