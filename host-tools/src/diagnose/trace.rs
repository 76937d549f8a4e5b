//! Readings beside what was predicted for them.

use super::fit::{CHANNELS, Reading};
use super::measurements::column_name;
use super::outcome::Outcome;

/// One measured channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// The name of its column.
    pub channel: String,
    /// For every row of the campaign; none where nothing was measured or the row was not used.
    pub rows: Vec<Option<Traced>>,
}

/// One reading and what was predicted for it, in the channel's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Traced {
    /// The reading.
    pub measured: f64,
    /// One standard deviation of its noise, above 0.
    pub noise: f64,
    /// Predicted by the declared model, refitted without the row's run; none where it has no answer.
    pub before: Option<f64>,
    /// Predicted with the effects found, fitted without the row's run.
    pub after: Option<f64>,
}

impl Outcome {
    /// Readings and their predictions by channel, for each of a campaign's `rows`.
    pub fn traces(&self, rows: usize) -> Vec<Trace> {
        let measured = Reading::JUDGED.into_iter().filter(|reading| self.measurements.has(*reading));
        measured
            .map(|reading| Trace { channel: column_name(reading).to_owned(), rows: self.traced(reading, rows) })
            .collect()
    }

    fn traced(&self, reading: Reading, rows: usize) -> Vec<Option<Traced>> {
        let mut traced = vec![None; rows];
        let name = column_name(reading);
        let noise = self.document.channels.get(name).map_or(1.0, |channel| channel.noise);
        for (row, place) in self.measurements.places.iter().enumerate() {
            let measured = self.measurements.rows[row].readings[reading.index()];
            let predicted = |errors: &[[Option<f64>; CHANNELS]]| Some(measured? - errors[row][reading.index()]?);
            if let (Some(measured), Some(entry)) = (measured, traced.get_mut(*place)) {
                let (before, after) = (predicted(&self.errors.before), predicted(&self.errors.after));
                *entry = Some(Traced { measured, noise, before, after });
            }
        }
        traced
    }
}
