//! Rows that stand alone: what they read no other row bears out.
//!
//! One slip that was noted wrongly is many standard deviations off in every channel, and an effect that bends just there gains by it. Loss
//! that grows linearly does not help against that: the row is alone where it seems to be. So where a few rows are far out, the search is done
//! without them. What is found is found by the others; where it explains these rows, too, they count. Where far rows have their place in
//! common, as the first of every run, a law is missing that shows there, and none of them stands alone.

use super::fit::{Fit, Reading};
use super::measurements::{COLUMNS, Measurements, column_name};
use super::shared_place::share_a_place;
use crate::data::campaign::Campaign;
use crate::statistics::robust_std;

/// Times what is usual in its channel from which a reading is far out.
const FAR_OUT: f64 = 6.0;
/// Share of all rows that may stand alone for a model; more of them do not, together.
pub const FEW: f64 = 0.1;
/// Fewer rows do not tell which of them is wrong.
const LEAST_ROWS: usize = 12;
/// Rows that are named one by one.
const NAMED: usize = 3;

/// A row that stands alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoneRow {
    /// Its place in the campaign.
    pub place: usize,
    /// The channel in which it is farthest out.
    pub channel: Reading,
    /// By how many times what is usual there.
    pub times: f64,
}

/// Rows that a fit leaves far out, if they are few; the farthest first.
pub fn lone_rows(measurements: &Measurements, fit: &Fit) -> Vec<LoneRow> {
    let rows = fit.standardised.len();
    if rows < LEAST_ROWS {
        return Vec::new();
    }
    let usual = Reading::ALL.map(|channel| {
        // Not a number of a channel that is not there: the greater of it and 1 is 1.
        robust_std(fit.standardised.iter().filter_map(|row| row[channel.index()])).max(1.0)
    });
    let farthest = |(row, left): (usize, &[Option<f64>; COLUMNS.len()])| {
        let times = |channel: Reading| Some((channel, left[channel.index()]?.abs() / usual[channel.index()]));
        let (channel, times) = Reading::ALL.into_iter().filter_map(times).max_by(|a, b| a.1.total_cmp(&b.1))?;
        (times > FAR_OUT).then_some(LoneRow { place: measurements.places[row], channel, times })
    };
    let (far, mut found): (Vec<usize>, Vec<LoneRow>) =
        fit.standardised.iter().enumerate().filter_map(|row| Some((row.0, farthest(row)?))).unzip();
    found.sort_by(|a, b| b.times.total_cmp(&a.times));
    let stand_alone = far.len() as f64 <= FEW * rows as f64 && !share_a_place(measurements, &far);
    if stand_alone { found } else { Vec::new() }
}

/// What is said of rows that were set aside; none where none were.
pub fn in_words(campaign: &Campaign, rows: &[LoneRow]) -> Option<String> {
    let name = |lone: &LoneRow| {
        let row = &campaign.rows()[lone.place];
        let channel = column_name(lone.channel);
        format!("run {} at {} s ({channel} off by {:.0} times what is usual)", row.run, row.t_s, lone.times)
    };
    let named: Vec<String> = rows.iter().take(NAMED).map(name).collect();
    let others = rows.len().saturating_sub(NAMED);
    let and_others = if others > 0 { format!(" and {others} more") } else { String::new() };
    (!rows.is_empty()).then(|| {
        format!(
            "Set aside, since no other row bears them out: {}{and_others}. They are gross errors, such as a slip noted wrongly, or tell of \
             something that these rows alone show.",
            named.join(", ")
        )
    })
}
