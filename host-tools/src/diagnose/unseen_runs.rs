//! What a model says of runs that it has not seen, and what one model says better than another.

use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::bench::Bench;
use super::fit::HeldOutRun;
use super::trial::Trial;

/// Groups that many runs are divided into; each is left out in turn.
const GROUPS: usize = 6;
/// Runs up to which each is left out by itself.
const FEW_RUNS: usize = 30;
/// Rows up to which they are.
const FEW_ROWS: usize = 60;

/// Degrees of freedom by which two runs are judged, too: one would never be enough.
const LEAST_FREEDOM: f64 = 2.0;

/// Runs dealt out to groups, so that neighbours, which are often alike, are in different ones.
pub fn groups(runs: usize, rows: usize) -> Vec<Vec<usize>> {
    let count = if runs <= FEW_RUNS && rows <= FEW_ROWS { runs } else { runs.min(GROUPS) };
    (0..count).map(|group| (group..runs).step_by(count).collect()).collect()
}

/// Each run (or each row, of a campaign of one run) predicted without its own help, to first order.
pub fn nearly_held_out(bench: &Bench<'_>, trial: &Trial<'_>) -> Vec<HeldOutRun> {
    let runs = (0..bench.measurements.runs.len()).filter(|run| !bench.without.contains(run));
    let predict = |run: usize| trial.fit.leave_out(&trial.model, &[run]).ok().and_then(|mut found| found.runs.pop());
    runs.map(|run| predict(run).unwrap_or_else(|| HeldOutRun::without_answer(run))).collect()
}

/// Each run (or each row, of a campaign of one run) predicted by a fit without its group of runs. A step from the fit to all of
/// them would do for a linear model; along a valley that bends it ends anywhere.
pub fn held_out(bench: &Bench<'_>, trial: &Trial<'_>) -> Vec<HeldOutRun> {
    let runs: Vec<usize> = (0..bench.measurements.runs.len()).filter(|run| !bench.without.contains(run)).collect();
    let groups = groups(runs.len(), bench.measurements.rows.len());
    let predict = |group: &Vec<usize>| {
        let group: Vec<usize> = group.iter().map(|place| runs[*place]).collect();
        let without: Vec<usize> = bench.without.iter().chain(&group).copied().collect();
        let [runs] = bench.without(&without).predict_shortly(trial, [&group]);
        runs
    };
    let mut predicted: Vec<HeldOutRun> = groups.par_iter().flat_map_iter(predict).collect();
    predicted.sort_by_key(|run| run.run);
    predicted
}

/// What one model says better than another of runs that neither has seen, in log predictive density.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeldOutGain {
    /// Mean gain a row, in nats.
    pub per_row: f64,
    /// One standard deviation of that, over runs.
    pub std: f64,
    /// What is left of it without the run that gains most.
    pub without_most: f64,
    /// Over how many runs.
    pub runs: usize,
}

impl HeldOutGain {
    /// Of a model that has no answer where the other had one.
    const LOST: Self = Self { per_row: f64::NEG_INFINITY, std: 0.0, without_most: f64::NEG_INFINITY, runs: 0 };

    /// Of the second model over the first. Runs for which the first had no answer count for nothing; a second without an answer
    /// where the first had one has lost.
    pub fn over(before: &[HeldOutRun], after: &[HeldOutRun]) -> Self {
        let scores = |runs: &[HeldOutRun]| runs.iter().map(|run| run.log_score).collect::<Vec<_>>();
        let Some(gains) = gains(&scores(before), &scores(after)) else { return Self::LOST };
        let rows = before.iter().map(|run| run.rows.len()).sum::<usize>().max(1) as f64;
        let (sum, std) = summed(&gains);
        let most = gains.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Self { per_row: sum / rows, std: std / rows, without_most: (sum - most) / rows, runs: gains.len() }
    }

    /// Whether the second model had an answer where the first had one.
    pub fn has_answer(&self) -> bool {
        *self != Self::LOST
    }

    /// Whether it is more than so many standard errors.
    pub fn exceeds(&self, errors: f64) -> bool {
        self.per_row > errors * self.std
    }

    /// The chance of such a gain over runs that gain nothing in the mean: of Student's t.
    pub fn chance(&self) -> f64 {
        let freedom = (self.runs as f64 - 1.0).max(LEAST_FREEDOM);
        StudentsT::new(0.0, 1.0, freedom).map_or(1.0, |law| law.sf(self.per_row / self.std.max(f64::MIN_POSITIVE)))
    }

    /// Whether more than one run gains. What one alone does, while the others together lose, may be a gross error of its own: a model that is
    /// less sure of such a row is surprised the less.
    pub fn is_shared(&self) -> bool {
        self.runs > 1 && self.without_most > 0.0
    }
}

/// What one model gains over another in ln density. What the first had no answer for counts for nothing; none where only the second has none.
pub fn gains(before: &[Option<f64>], after: &[Option<f64>]) -> Option<Vec<f64>> {
    let answered = before.iter().zip(after).filter_map(|(before, after)| Some(((*before)?, *after)));
    answered.map(|(before, after)| Some(after? - before)).collect()
}

/// Their sum and one standard deviation of it, from how they differ.
pub fn summed(gains: &[f64]) -> (f64, f64) {
    let count = gains.len() as f64;
    let mean = gains.iter().sum::<f64>() / count.max(1.0);
    let variance = gains.iter().map(|gain| (gain - mean).powi(2)).sum::<f64>() / (count - 1.0).max(1.0);
    (mean * count, (variance * count).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scored(scores: [f64; 4]) -> Vec<HeldOutRun> {
        let of = |(run, score)| HeldOutRun { log_score: Some(score), ..HeldOutRun::without_answer(run) };
        scores.into_iter().enumerate().map(of).collect()
    }

    #[test]
    fn what_one_run_gains_while_the_others_lose_is_not_shared() {
        let before = scored([-5.0; 4]);
        let gain = |of_runs: [f64; 4]| HeldOutGain::over(&before, &scored(of_runs.map(|gain| gain - 5.0)));
        let of_one = gain([9.0, -1.0, -1.0, -1.0]);
        assert!(of_one.exceeds(0.0) && !of_one.is_shared(), "{of_one:?}");
        let of_many = gain([9.0, 1.0, -0.5, 1.0]);
        assert!(of_many.exceeds(0.0) && of_many.is_shared(), "{of_many:?}");
        assert!(!gain([-1.0, 0.5, -1.0, -1.0]).is_shared());
    }
}
