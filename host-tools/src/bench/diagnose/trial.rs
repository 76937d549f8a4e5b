//! The campaigns of a benchmark: drawn, diagnosed, side by side.

use std::path::Path;
use std::time::Instant;

use indicatif::ParallelProgressIterator;
use rayon::prelude::*;

use super::answer::Answer;
use super::campaign_draw::{Drawn, Subject, Truth, draw};
use super::chance::Chance;
use super::shared_errors::SharedErrors;
use super::undeclared::effect_ids;
use super::unlisted::UNLISTED;
use crate::data::campaign::Campaign;
use crate::error::HostError;
use crate::progress::bar;

/// A diagnosis that is put to the test: a campaign in, what it says out.
pub type Diagnoser<'a> = dyn Fn(&Campaign) -> Result<Answer, HostError> + Sync + 'a;

/// How many campaigns of each kind.
#[derive(Debug, Clone, Copy)]
pub struct Counts {
    /// With each effect of the list.
    pub per_effect: u64,
    /// With nothing undeclared.
    pub clean: u64,
    /// With two effects.
    pub pairs: u64,
    /// With an effect of no list.
    pub unlisted: u64,
}

/// A campaign that was drawn, and what was said of it.
pub struct Trial {
    /// Its name: what it was drawn for, and its number.
    pub name: String,
    /// What is true of it.
    pub truth: Truth,
    /// What was said, or why nothing was.
    pub answer: Result<Answer, String>,
    /// How long that took, s.
    pub seconds: f64,
}

/// What is drawn: a subject, and the number of the draw within it.
pub type Plan = Vec<(Subject, u64)>;

/// The draws of a benchmark; `only` leaves those in which this effect is.
pub fn plan(counts: &Counts, seed: u64, only: Option<&str>) -> Plan {
    let mut plan = Plan::new();
    for id in effect_ids() {
        plan.extend((0..counts.per_effect).map(|number| (Subject::One(id), number)));
    }
    plan.extend((0..counts.pairs).map(|number| (pair(seed, number), number)));
    plan.extend((0..counts.unlisted).map(|number| {
        let unlisted = &UNLISTED[number as usize % UNLISTED.len()];
        (Subject::Unlisted(unlisted), number / UNLISTED.len() as u64)
    }));
    plan.extend((0..counts.clean).map(|number| (Subject::Clean, number)));
    if let Some(only) = only {
        plan.retain(|(subject, _)| match subject {
            Subject::One(id) => *id == only,
            Subject::Two(first, second) => *first == only || *second == only,
            Subject::Clean | Subject::Unlisted(_) => false,
        });
    }
    plan
}

fn pair(seed: u64, number: u64) -> Subject {
    let mut chance = Chance::new(seed, "pairs", number);
    let first = chance.pick(&effect_ids());
    let others: Vec<&'static str> = effect_ids().into_iter().filter(|id| *id != first).collect();
    Subject::Two(first, chance.pick(&others))
}

/// Draws the campaigns of a plan; in place of one that cannot be drawn, its subject.
pub fn draw_all(plan: &Plan, errors: SharedErrors, seed: u64) -> Vec<Result<Drawn, Subject>> {
    let drawn = |(subject, number): &(Subject, u64)| draw(*subject, errors, seed, *number).ok_or(*subject);
    plan.par_iter().progress_with(bar("drawing", plan.len())).map(drawn).collect()
}

/// Diagnoses campaigns.
pub fn diagnose_all(drawn: &[Drawn], diagnose: &Diagnoser<'_>) -> Vec<Trial> {
    let trial = |drawn: &Drawn| {
        let start = Instant::now();
        let answer = drawn.written.campaign(&drawn.name).and_then(|campaign| diagnose(&campaign));
        Trial {
            name: drawn.name.clone(),
            truth: drawn.truth.clone(),
            answer: answer.map_err(|error| error.to_string()),
            seconds: start.elapsed().as_secs_f64(),
        }
    };
    drawn.par_iter().progress_with(bar("diagnosing", drawn.len())).map(trial).collect()
}

/// Writes the campaigns for a person to look at.
///
/// # Errors
/// Where the file system refuses.
pub fn save_all(drawn: &[Drawn], folder: &Path) -> Result<(), HostError> {
    std::fs::create_dir_all(folder).map_err(HostError::file(folder))?;
    drawn.iter().try_for_each(|drawn| {
        let truth = format!(
            "{}\nsize {:.2} σ\nsoil {}\n",
            drawn.truth.laws.join("\n"),
            drawn.truth.size,
            if drawn.truth.known_soil { "known" } else { "free" }
        );
        drawn.written.save(folder, &drawn.name, &truth)
    })
}
