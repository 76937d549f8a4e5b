//! Errors on runs that took part neither in a fit nor in choosing its effects.

use rayon::prelude::*;

use super::fit::{CHANNELS, HeldOut};
use super::folds::{Fold, choose};
use super::trial::{Bench, Trial};
use super::unseen_runs::groups;

/// Predictions of each row by models that did not know its run.
#[derive(Debug, Clone)]
pub struct HeldOutErrors {
    /// Measured less predicted by the declared model, for each row and channel.
    pub before: Vec<[Option<f64>; CHANNELS]>,
    /// The same with the effects that were chosen without the run.
    pub after: Vec<[Option<f64>; CHANNELS]>,
}

impl HeldOutErrors {
    /// Those of rows of which none is predicted yet.
    pub fn none_yet(rows: usize) -> Self {
        Self { before: vec![[None; CHANNELS]; rows], after: vec![[None; CHANNELS]; rows] }
    }
}

/// Leaves out each group of runs in turn: fits the declared model to the others, chooses as many effects as were found among
/// those that came near on all runs, and predicts the group.
pub fn held_out_errors<'a>(
    bench: &Bench<'a>,
    base: &Trial<'a>,
    shortlists: &[Vec<Trial<'a>>],
    progress: &(dyn Fn(&str) + Sync),
) -> HeldOutErrors {
    let groups = groups(bench.measurements.runs.len(), bench.measurements.rows.len());
    let fold = |(group, runs): (usize, &Vec<usize>)| {
        let bench = bench.without(runs);
        let before = bench.refit(base)?;
        Some(Fold { group, bench, after: before.clone(), before })
    };
    let mut folds: Vec<Fold<'a>> = groups.par_iter().enumerate().filter_map(fold).collect();
    for (place, shortlist) in shortlists.iter().enumerate() {
        progress(&format!("held-out runs, effect {}", place + 1));
        choose(&mut folds, &groups, shortlist);
    }
    let predicted = |fold: &Fold<'a>| {
        let predicted = |trial: &Trial<'a>| trial.fit.predict_unseen(&trial.model, &groups[fold.group]).ok();
        Some((predicted(&fold.before)?, predicted(&fold.after)?))
    };
    let predictions: Vec<_> = folds.par_iter().filter_map(predicted).collect();
    let mut errors = HeldOutErrors::none_yet(bench.measurements.rows.len());
    for (before, after) in &predictions {
        note(before, &mut errors.before);
        note(after, &mut errors.after);
    }
    errors
}

/// Puts predictions in their rows.
pub fn note(predictions: &HeldOut, residuals: &mut [[Option<f64>; CHANNELS]]) {
    for row in predictions.runs.iter().flat_map(|run| &run.rows) {
        residuals[row.row] = row.residual;
    }
}

/// Root mean square of a channel's residuals over some rows; none without any.
pub fn rmse(residuals: &[[Option<f64>; CHANNELS]], channel: usize, rows: impl Fn(usize) -> bool) -> Option<f64> {
    let squares = residuals.iter().enumerate().filter(|(row, _)| rows(*row)).filter_map(|(_, row)| row[channel]);
    let (sum, count) = squares.fold((0.0, 0.0), |(sum, count), residual| (sum + residual * residual, count + 1.0));
    (count > 0.0).then(|| f64::sqrt(sum / count))
}
