//! Effects that one is told of, judged as if there were no others: what a campaign could show at best.

use kapvik_firmware::terramechanics::effects::effect_info;

use super::bench::Bench;
use super::candidates::is_measured;
use super::field::chosen;
use super::gain_chance::Gain;
use super::outcome::{DiagnoseOptions, declared_model, measured};
use super::selection::SIGNIFICANT;
use super::specification::EffectForm;
use super::trial::Trial;
use super::unseen_runs::{HeldOutGain, held_out};
use crate::data::campaign::Campaign;
use crate::error::HostError;

/// What an effect does on top of the others that one is told of.
#[derive(Debug, Clone, Copy)]
pub struct Told {
    /// The chance of what it gains, if it changed nothing and no other effect had been tried.
    pub p_value: f64,
    /// Gain in log predictive density on runs that the fits did not see, nats a row.
    pub gain_per_row: f64,
}

impl Told {
    /// Whether it shows beyond chance.
    pub fn is_detectable(&self) -> bool {
        self.p_value < SIGNIFICANT && self.gain_per_row > 0.0
    }
}

/// Each of some effects, in its best form, on top of the declared model with all the others; none where a model has no fit.
///
/// # Errors
/// As of a diagnosis.
pub fn told(campaign: &Campaign, ids: &[&str]) -> Result<Vec<Option<Told>>, HostError> {
    let measurements = measured(campaign, &DiagnoseOptions::default(), &[])?;
    let bench = Bench::new(campaign, &measurements);
    let declared = declared_model(&bench)?;
    let judge = |last: &&str| {
        let others = ids.iter().filter(|id| *id != last);
        let without = others.into_iter().try_fold(declared.clone(), |trial, id| add(&bench, &trial, id))?;
        let with = add(&bench, &without, last)?;
        let rows_per_reading = with.fit.rows_per_reading();
        let gain = Gain { rows_per_reading, ..Gain::over(&without, &with, with.fit.dispersion.max(1.0)) };
        let gain_per_row = HeldOutGain::over(&held_out(&bench, &without), &held_out(&bench, &with)).per_row;
        Some(Told { p_value: gain.chance(with.added_parameters(), 1), gain_per_row })
    };
    Ok(ids.iter().map(judge).collect())
}

/// A model with an effect more, in its best form.
fn add<'a>(bench: &Bench<'a>, trial: &Trial<'a>, id: &str) -> Option<Trial<'a>> {
    let trials = forms(bench, id).iter().filter_map(|form| bench.with_effect(trial, form)).collect();
    chosen(bench, trial, trials)
}

fn forms(bench: &Bench<'_>, id: &str) -> Vec<EffectForm> {
    let all = effect_info(id).into_iter().flat_map(EffectForm::each_of);
    all.filter(|effect| is_measured(bench.campaign, bench.measurements, effect.form)).collect()
}
