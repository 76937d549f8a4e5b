//! Cases: observations drawn from the prior, with their truth and their posterior.

use kapvik_firmware::wheel_state::SoilQuery;
use rayon::prelude::*;

use super::coordinates::Targets;
use super::sampler::Effort;
use super::summary::{NoPosterior, Summary, draws};
use super::wheel_likelihood::LoadPrior;
use crate::prior;
use crate::train::dataset::stream;
use crate::train::example::targets;
use crate::train::observe::observe;
use crate::train::scene::{Design, Scene, scenes};

/// The loads that [`Design::Kapvik`] draws.
pub const KAPVIK_LOADS: LoadPrior = LoadPrior::Between(
    prior::KAPVIK_LOAD_N * (1.0 - prior::KAPVIK_LOAD_SPREAD),
    prior::KAPVIK_LOAD_N * (1.0 + prior::KAPVIK_LOAD_SPREAD),
);

/// One observation, what is true of it, and what its posterior says.
#[derive(Debug, Clone)]
pub struct Case {
    /// What was seen.
    pub query: SoilQuery,
    /// What is true.
    pub truth: Targets,
    /// What can be said.
    pub summary: Summary,
}

/// `count` cases, each one noisy observation of a scene. The same seed gives the same cases. `done` is called after each.
///
/// # Errors
/// Where the posterior of a case cannot be sampled: then it is the method that fails, and no case may be left out.
pub fn cases(
    design: Design,
    count: usize,
    seed: u32,
    load: LoadPrior,
    effort: &Effort,
    done: impl Fn() + Sync,
) -> Result<Vec<Case>, NoPosterior> {
    let case = |(index, scene): (usize, &Scene)| {
        let mut random = stream(u64::from(seed), index);
        let query = observe(scene, &mut random);
        let summary = Summary::new(&draws(&query, load, effort, &mut random)?);
        done();
        Ok(Case { query, truth: targets(scene), summary })
    };
    scenes(design, count, seed).par_iter().enumerate().map(case).collect()
}
