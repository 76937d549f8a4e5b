//! Errors on runs that took part neither in a fit nor in choosing its effects.

use rayon::prelude::*;

use super::bench::Bench;
use super::document::ErrorPair;
use super::fit::{CHANNELS, HeldOut};
use super::folds::{Fold, choose};
use super::lone_rows::FEW;
use super::trial::Trial;
use super::unseen_runs::groups;
use crate::statistics::{root_mean_square, sorted};

/// A standard deviation over the root mean square of all errors but the farthest tenth, of a normal distribution.
const PER_NEAR: f64 = 1.267;

/// Predictions of each row by models that did not know its run.
#[derive(Debug, Clone)]
pub struct HeldOutErrors {
    /// Measured less predicted by the declared model, for each row and channel.
    pub before: Vec<[Option<f64>; CHANNELS]>,
    /// The same with the effects that were chosen without the run.
    pub after: Vec<[Option<f64>; CHANNELS]>,
    /// One standard deviation of that as parameters, slip, load and noise have it, of a run that is off by nothing of its own.
    pub expected: Vec<[Option<f64>; CHANNELS]>,
}

impl HeldOutErrors {
    /// Those of rows of which none is predicted yet.
    pub fn none_yet(rows: usize) -> Self {
        let none = vec![[None; CHANNELS]; rows];
        Self { before: none.clone(), after: none.clone(), expected: none }
    }

    /// Whether both models predicted a channel in a row.
    pub fn has(&self, row: usize, channel: usize) -> bool {
        self.before[row][channel].is_some() && self.after[row][channel].is_some()
    }

    /// Root mean square errors of a channel over those of some rows that both models predicted; none without any.
    pub fn pair(&self, channel: usize, rows: impl Fn(usize) -> bool) -> Option<ErrorPair> {
        let both = (0..self.before.len()).filter(|row| rows(*row) && self.has(*row, channel));
        let rmse = |residuals: &[[Option<f64>; CHANNELS]]| {
            let rmse = root_mean_square(both.clone().filter_map(|row| residuals[row][channel]));
            rmse.is_finite().then_some(rmse)
        };
        Some(ErrorPair { rmse_before: rmse(&self.before)?, rmse_after: rmse(&self.after)? })
    }

    /// By how many times the errors of a channel with the effects exceed what is expected of them, by all readings but the farthest tenth, which
    /// may be gross errors; none of a channel of which nothing is expected.
    pub fn times_expected(&self, channel: usize) -> Option<f64> {
        let both = self.after.iter().zip(&self.expected).filter_map(|(error, std)| error[channel].zip(std[channel]));
        let times = sorted(both.filter(|(_, std)| *std > 0.0).map(|(error, std)| (error / std).abs()));
        let near = &times[..times.len() - (FEW * times.len() as f64).ceil() as usize];
        let squares: f64 = near.iter().map(|times| times * times).sum();
        (!near.is_empty()).then(|| PER_NEAR * f64::sqrt(squares / near.len() as f64))
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
        for row in after.runs.iter().flat_map(|run| &run.rows) {
            errors.expected[row.row] = row.std_within_run;
        }
    }
    errors
}

/// Puts predictions in their rows.
pub fn note(predictions: &HeldOut, residuals: &mut [[Option<f64>; CHANNELS]]) {
    for row in predictions.runs.iter().flat_map(|run| &run.rows) {
        residuals[row.row] = row.residual;
    }
}
