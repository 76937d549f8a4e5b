//! Candidates on top of one model that are in question, and the best of them.

use super::bench::{Bench, Glance};
use super::fit::HeldOutRun;
use super::selection::{dispersion, enough, is_misfit, predicts_better, worth};
use super::trial::Trial;
use super::unseen_runs::{HeldOutGain, held_out};

/// Times the distance at which candidates are in question from which a few steps will not bring one near.
const FAR_BEHIND: f64 = 2.0;

/// Candidates on top of a model that are in question.
#[derive(Debug, Clone)]
pub struct Field<'a> {
    /// The model without any of them.
    pub base: Trial<'a>,
    /// The candidates.
    pub trials: Vec<Trial<'a>>,
    /// Whether more than one effect is missing.
    misfit: bool,
}

impl<'a> Field<'a> {
    /// Those of some fitted candidates that are in question.
    pub fn new(base: &Trial<'a>, trials: Vec<Trial<'a>>) -> Self {
        let enough = enough(&trials, dispersion(base, &trials, &[]));
        let mut all = Self::all(base, trials);
        all.trials.retain(|trial| worth(trial) > enough);
        all
    }

    /// All of them.
    pub(super) fn all(base: &Trial<'a>, trials: Vec<Trial<'a>>) -> Self {
        Self { base: base.clone(), misfit: is_misfit(trials.iter()), trials }
    }

    /// A shortlist of candidates, each as it was fitted to all runs, fitted to a bench's runs: from there if it stood on the
    /// same effects as the model does. One that is far behind after a few steps is left there.
    pub fn of_shortlist(bench: &Bench<'a>, base: &Trial<'a>, shortlist: &[Trial<'a>]) -> Self {
        let names = base.specification.names();
        let held = bench.held(&base.fit);
        let begin = |known: &Trial<'a>| {
            let effect = known.added()?;
            if base.specification.has(effect.info.id) {
                return None;
            }
            let stands = known.specification.names().split_last().is_some_and(|(_, before)| before == names);
            if stands { bench.refit_briefly(known).map(Glance::of) } else { bench.glance(&held, base, effect) }
        };
        let begun: Vec<Glance<'a>> = shortlist.iter().filter_map(begin).collect();
        let all: Vec<_> = begun.iter().map(|glance| glance.better.clone()).collect();
        let near = enough(&all, FAR_BEHIND * dispersion(base, &all, &[]));
        let near = begun.iter().filter(|glance| worth(&glance.better) > near);
        Self::new(base, near.filter_map(|glance| bench.pursued(glance)).collect())
    }

    /// The models whose predictions of unseen runs decide: that without any candidate, then the candidates; none where no two
    /// of them are in question.
    pub fn models(&self) -> Vec<&Trial<'a>> {
        if self.trials.len() < 2 { Vec::new() } else { std::iter::once(&self.base).chain(&self.trials).collect() }
    }

    /// The best by what [`Field::models`] say of unseen runs, by the rule of [`super::selection::step`]; none where none is in
    /// question.
    pub fn best(&self, predicted: &[Vec<HeldOutRun>]) -> Option<&Trial<'a>> {
        let Some((before, predicted)) = predicted.split_first() else { return self.trials.first() };
        let all = || self.trials.iter().zip(predicted);
        let leader = all().max_by(|a, b| worth(a.0).total_cmp(&worth(b.0)))?;
        let gain = |runs: &[HeldOutRun]| HeldOutGain::over(before, runs).per_row;
        let better = all().filter(|(_, runs)| self.misfit || predicts_better(runs, leader.1));
        let best = better.max_by(|a, b| gain(a.1).total_cmp(&gain(b.1)));
        Some(best.unwrap_or(leader).0)
    }
}

/// The best of some candidates.
pub fn chosen<'a>(bench: &Bench<'a>, base: &Trial<'a>, trials: Vec<Trial<'a>>) -> Option<Trial<'a>> {
    let field = Field::new(base, trials);
    let predicted: Vec<_> = field.models().into_iter().map(|trial| held_out(bench, trial)).collect();
    field.best(&predicted).cloned()
}
