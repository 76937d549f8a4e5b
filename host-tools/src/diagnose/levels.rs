//! Whole levels of slip left out, which asks more of a model than runs beside others at the same slip.

use super::assemble::{error_pairs, told};
use super::document::LevelsLeftOut;
use super::forward::Selected;
use super::held_out_errors::{HeldOutErrors, note};
use super::measurements::Measurements;
use super::trial::Trial;

/// Slips closer than this are one level.
const SAME_LEVEL: f64 = 0.03;
/// Most levels that are told apart; more is a spread.
const MOST_LEVELS: usize = 12;

/// Errors with each level of slip left out of the fits of both models in turn, as far as both predict it; none where slips do not come in
/// levels of several runs, or no level is predicted. The effects are those that all runs chose.
pub fn levels_left_out(measurements: &Measurements, selected: &Selected<'_>) -> Option<LevelsLeftOut> {
    let mut errors = HeldOutErrors::none_yet(measurements.rows.len());
    let mut slips = Vec::new();
    for (slip, runs) in levels(measurements)? {
        let predict = |trial: &Trial<'_>| trial.fit.leave_out_exact(&trial.model, &runs).ok();
        let (Some(before), Some(after)) = (predict(&selected.base), predict(selected.model())) else { continue };
        note(&before, &mut errors.before);
        note(&after, &mut errors.after);
        slips.push(slip);
    }
    let channels = error_pairs(&errors, &told(measurements, selected), |_| true);
    (!slips.is_empty()).then_some(LevelsLeftOut { slips, channels })
}

/// Slip (of its lowest run) and runs of each level, where the runs each stay at one.
fn levels(measurements: &Measurements) -> Option<Vec<(f64, Vec<usize>)>> {
    let mut runs: Vec<(f64, usize)> = Vec::new();
    for run in 0..measurements.runs.len() {
        let mean = measurements.mean_slip(run);
        if measurements.slips(run).any(|slip| (slip - mean).abs() > SAME_LEVEL) {
            return None;
        }
        runs.push((mean, run));
    }
    runs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut levels: Vec<(f64, Vec<usize>)> = Vec::new();
    for (slip, run) in runs {
        match levels.last_mut() {
            Some((lowest, of_level)) if slip - *lowest < SAME_LEVEL => of_level.push(run),
            _ => levels.push((slip, vec![run])),
        }
    }
    let repeated = levels.iter().any(|(_, runs)| runs.len() > 1);
    (repeated && (3..=MOST_LEVELS).contains(&levels.len())).then_some(levels)
}
