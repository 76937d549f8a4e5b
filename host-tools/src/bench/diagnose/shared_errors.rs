//! Errors that the rows of a run share. No campaign's file states them, and no effect of the list is what they do.

use clap::ValueEnum;

use super::chance::Chance;
use super::layout::Layout;
use super::state::LOAD;
use crate::prior::Range;

/// How the errors of a run's rows hang together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum SharedErrors {
    /// White noise, in a quarter of the campaigns of longer runs beside offsets of up to its size.
    #[default]
    Usual,
    /// White noise alone, in few runs of several rows; all others below as well.
    White,
    /// An offset of each run in drawbar pull, torque, sinkage and load.
    Offsets,
    /// Noise that is remembered for some rows, beside the white one, in the same channels.
    Red,
    /// A line along each run, in the same channels.
    Drift,
}

/// Channels that share errors, by their place in [`super::state::MEASURED`].
const CHANNELS: [usize; 4] = [0, 1, 2, LOAD];
/// Standard deviation of the offsets, of the ends of the lines and of what is remembered, over the white noise.
const SIZE: Range = Range { low: 0.5, high: 3.0, logarithmic: true };
/// Rows after which the memory has fallen to 1/e.
const MEMORY_ROWS: Range = Range { low: 1.0, high: 30.0, logarithmic: true };

/// The shared errors of a channel, all in units of its noise.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct OfChannel {
    /// One standard deviation of what the runs are off.
    offset: f64,
    /// The same of what they drift from their middle to their end.
    drift: f64,
    /// One standard deviation of what is remembered.
    remembered: f64,
    /// Correlation of that from row to row.
    correlation: f64,
}

/// The shared errors of a campaign.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Shared([OfChannel; 6]);

impl Shared {
    /// Draws them. Of the usual ones nothing: those are the instruments' own.
    pub fn draw(chance: &mut Chance, kind: SharedErrors) -> Self {
        let mut shared = Self::default();
        for place in CHANNELS {
            let channel = &mut shared.0[place];
            match kind {
                SharedErrors::Usual | SharedErrors::White => {}
                SharedErrors::Offsets => channel.offset = chance.of(SIZE),
                SharedErrors::Drift => channel.drift = chance.of(SIZE),
                SharedErrors::Red => {
                    channel.remembered = chance.of(SIZE);
                    channel.correlation = libm::exp(-1.0 / chance.of(MEMORY_ROWS));
                }
            }
        }
        shared
    }

    /// What each row of a campaign is off, in units of the noise of each channel.
    pub fn errors(&self, chance: &mut Chance, layout: &Layout) -> Vec<[f64; 6]> {
        let mut errors = vec![[0.0; 6]; layout.rows.len()];
        for of_run in errors.chunks_mut(layout.rows_per_run) {
            for place in CHANNELS {
                self.0[place].act(chance, of_run, place);
            }
        }
        errors
    }
}

impl OfChannel {
    fn act(&self, chance: &mut Chance, of_run: &mut [[f64; 6]], place: usize) {
        if *self == Self::default() {
            return;
        }
        let (offset, drift) = (chance.normal(self.offset), chance.normal(self.drift));
        let (kept, renewed) = (self.correlation, (1.0 - self.correlation * self.correlation).sqrt());
        let mut remembered = chance.normal(1.0);
        let half = 0.5 * (of_run.len() - 1) as f64;
        for (row, errors) in of_run.iter_mut().enumerate() {
            let along = if half > 0.0 { row as f64 / half - 1.0 } else { 0.0 };
            errors[place] = offset + drift * along + self.remembered * remembered;
            remembered = kept * remembered + chance.normal(renewed);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::site::Site;
    use super::super::wants::Wants;
    use super::*;

    /// The mean of products of neighbours in a long record, with a standard error of about 0.02.
    #[test]
    fn red_noise_remembers_as_much_as_is_said() {
        let mut chance = Chance::new(11, "memory", 0);
        let channel = OfChannel { remembered: 2.0, correlation: 0.9, ..OfChannel::default() };
        let mut errors = vec![[0.0; 6]; 40_000];
        channel.act(&mut chance, &mut errors, 2);
        let product = |lag: usize| {
            let pairs = errors.windows(lag + 1).map(|rows| rows[0][2] * rows[lag][2]);
            pairs.sum::<f64>() / (errors.len() - lag) as f64
        };
        assert!((product(0) - 4.0).abs() < 0.4, "{}", product(0));
        assert!((product(1) / product(0) - 0.9).abs() < 0.02, "{}", product(1));
        assert!((product(5) / product(0) - 0.9_f64.powi(5)).abs() < 0.06, "{}", product(5));
    }

    #[test]
    fn offsets_stay_and_drifts_do_not_within_a_run() {
        let mut chance = Chance::new(11, "shared", 0);
        let site = Site::draw(&mut chance, false);
        let wants = Wants { long_runs: true, few_runs: true, ..Wants::default() };
        let layout = Layout::draw(&mut chance, &site, &wants);
        assert!(layout.rows_per_run > 1 && (4..=24).contains(&layout.runs), "{}", layout.runs);
        let of = |kind, chance: &mut Chance| Shared::draw(chance, kind).errors(chance, &layout);
        for errors in of(SharedErrors::Offsets, &mut chance).chunks(layout.rows_per_run) {
            assert!(errors.iter().all(|row| *row == errors[0] && row[0] != 0.0 && row[3] == 0.0));
        }
        for errors in of(SharedErrors::Drift, &mut chance).chunks(layout.rows_per_run) {
            let [first, last] = [errors[0], errors[errors.len() - 1]];
            assert!(CHANNELS.iter().all(|place| first[*place] != 0.0 && (first[*place] + last[*place]).abs() < 1e-12));
        }
        assert!(of(SharedErrors::White, &mut chance).iter().all(|row| *row == [0.0; 6]));
    }
}
