//! The wheel states that a run of a campaign holds.

use std::cmp::Ordering;

use crate::data::campaign::{Campaign, Channel};
use crate::error::HostError;
use crate::statistics::sorted;

use super::SensorNoise;
use super::combine::{MeanState, Sample, combine};
use super::method::Method;

/// Why a row is left out at which a wheel is braked, or slips by too little.
const UNKNOWN_SLIP: &str = "the networks have learned no wheel that slips so little";
/// Why a row is left out at which a wheel has not sunk.
const NO_CONTACT: &str = "sinkage_m is not above 0, and at no sinkage the method has no contact";
/// A run as a method sees it.
#[derive(Debug, Clone)]
pub struct RunStates {
    /// Its name.
    pub run: String,
    /// Different times among the rows that were used.
    pub instants: usize,
    /// Rows that were used.
    pub rows_used: usize,
    /// Lines of the rows that were not, and why.
    pub rows_left_out: Vec<(u64, String)>,
    /// Rows as they are, or their means.
    pub states: Vec<MeanState>,
}

/// Every run of a campaign, in the order of the file, as a method sees it. A row without one of the columns that it needs is left out, and so
/// is one at a slip that it does not know, where there are others.
pub fn run_states(campaign: &Campaign, noise: &SensorNoise, method: Method) -> Vec<RunStates> {
    let of_run = |(run, rows): (&str, Vec<usize>)| {
        let (mut samples, mut rows_left_out) = (Vec::new(), Vec::new());
        for row in rows {
            let line = campaign.rows()[row].line;
            match sample(campaign, row, method) {
                Ok(sample) => samples.push((line, sample)),
                Err(reason) => rows_left_out.push((line, reason)),
            }
        }
        let is_known = |sample: &Sample| method.knows_slip(sample.slip, noise.slip.std);
        if samples.iter().any(|(_, sample)| is_known(sample)) {
            leave_out(&mut samples, &mut rows_left_out, UNKNOWN_SLIP, is_known);
        }
        // Of means it counts whether they are above 0: to leave out the rows that noise has pushed below would push them up.
        if method.needs_contact() && samples.len() <= method.most_states() {
            leave_out(&mut samples, &mut rows_left_out, NO_CONTACT, |sample| {
                sample.slip < 0.0 || sample.sinkage_m.is_none_or(|sinkage_m| sinkage_m > 0.0)
            });
        }
        let mut samples: Vec<Sample> = samples.into_iter().map(|(_, sample)| sample).collect();
        // In which order a file lists the wheels of an instant says nothing.
        let order = |sample: &Sample| [sample.t_s, sample.slip, sample.load_n];
        samples.sort_by(|one, other| {
            let pairs = order(one).into_iter().zip(order(other));
            pairs.fold(Ordering::Equal, |so_far, (one, other)| so_far.then(one.total_cmp(&other)))
        });
        let mut times = sorted(samples.iter().map(|sample| sample.t_s));
        times.dedup();
        RunStates {
            run: run.to_owned(),
            instants: times.len(),
            rows_used: samples.len(),
            rows_left_out,
            states: combine(&samples, method.most_states(), noise.slip.std, noise.load.std),
        }
    };
    campaign.runs().into_iter().map(of_run).collect()
}

/// Leaves out the rows that are not kept, by their lines.
fn leave_out(
    samples: &mut Vec<(u64, Sample)>,
    rows_left_out: &mut Vec<(u64, String)>,
    reason: &str,
    is_kept: impl Fn(&Sample) -> bool,
) {
    let left_out = samples.extract_if(.., |(_, sample)| !is_kept(sample));
    rows_left_out.extend(left_out.map(|(line, _)| (line, reason.to_owned())));
    rows_left_out.sort_by_key(|(line, _)| *line);
}

/// Checks that a campaign has the columns that a method needs.
///
/// # Errors
/// It names the columns that are missing and those that are needed.
pub fn check_columns(campaign: &Campaign, method: Method) -> Result<(), HostError> {
    let is_missing = |channel: &&Channel| campaign.column(channel.name()).is_none();
    let (needs, one_of) = (method.needs(), method.needs_one_of());
    let missing: Vec<Channel> = needs.iter().filter(is_missing).copied().collect();
    let has_one = one_of.is_empty() || !one_of.iter().all(|channel| is_missing(&channel));
    if missing.is_empty() && has_one {
        return Ok(());
    }
    let missing = if missing.is_empty() { names(one_of, " or ") } else { names(&missing, ", ") };
    let either = if one_of.is_empty() { String::new() } else { format!(", and {}", names(one_of, " or ")) };
    let needs = names(needs, ", ");
    Err(campaign.error(format!("no column {missing}: the method {} needs {needs}{either}", method.name())))
}

fn names(channels: &[Channel], between: &str) -> String {
    channels.iter().map(|channel| channel.name()).collect::<Vec<_>>().join(between)
}

/// The wheel state of a row, or what it lacks.
fn sample(campaign: &Campaign, row: usize, method: Method) -> Result<Sample, String> {
    let value = |channel| campaign.value(row, channel);
    if let Some(missing) = method.needs().iter().find(|channel| value(**channel).is_none()) {
        return Err(format!("no {}", missing.name()));
    }
    let one_of = method.needs_one_of();
    if !one_of.is_empty() && one_of.iter().all(|channel| value(*channel).is_none()) {
        return Err(format!("no {}", names(one_of, " or ")));
    }
    if let Some(reason) = campaign.gross_error(row) {
        return Err(reason);
    }
    let or_zero = |channel| value(channel).unwrap_or(0.0);
    let sample = Sample {
        t_s: campaign.rows()[row].t_s,
        slip: or_zero(Channel::Slip),
        load_n: or_zero(Channel::Load),
        drawbar_pull_n: value(Channel::DrawbarPull),
        torque_nm: value(Channel::Torque),
        sinkage_m: value(Channel::Sinkage),
        conditions: campaign.conditions(row),
    };
    if sample.load_n > 0.0 { Ok(sample) } else { Err("load_n is not above 0".to_owned()) }
}

impl RunStates {
    /// Why rows were left out, each reason once with its lines.
    pub fn reasons_in_words(&self) -> String {
        reasons_in_words(self.rows_left_out.iter().map(|(line, reason)| (*line, reason.as_str())))
    }
}

/// Why rows were left out, of their lines and reasons: each reason once with its lines.
pub fn reasons_in_words<'a>(left_out: impl Iterator<Item = (u64, &'a str)>) -> String {
    let mut reasons: Vec<(&str, Vec<String>)> = Vec::new();
    for (line, reason) in left_out {
        match reasons.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, lines)) => lines.push(line.to_string()),
            None => reasons.push((reason, vec![line.to_string()])),
        }
    }
    let words = reasons.into_iter().map(|(reason, lines)| format!("{reason} (line {})", abbreviated(&lines)));
    words.collect::<Vec<_>>().join("; ")
}

/// A list that stays readable.
fn abbreviated(lines: &[String]) -> String {
    const SHOWN: usize = 6;
    match lines.get(..SHOWN) {
        Some(first) if lines.len() > SHOWN => format!("{} and {} more", first.join(", "), lines.len() - SHOWN),
        _ => lines.join(", "),
    }
}
