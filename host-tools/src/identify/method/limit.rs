//! The mean of the exact posterior, by sampling, under the prior that the networks were trained with.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::identify::logarithmic::log_normal_std;
use crate::identify::target::is_told;
use crate::limit::coordinates::Targets;
use crate::limit::sampler::Effort;
use crate::limit::summary::{EFFORT, Summary, draws};
use crate::limit::wheel_likelihood::LoadPrior;
use crate::statistics::{quantile, sorted};

use super::networks::query;
use super::{Evidence, Finding, Statement};

/// Mean and intervals of the posterior.
///
/// # Errors
/// Where the observation is so far from the prior that there is no posterior to sample.
pub fn posterior_mean(evidence: &Evidence) -> Result<Finding, String> {
    let effort: &Effort = &EFFORT;
    let mut random = ChaCha8Rng::seed_from_u64(0);
    let found = draws(&query(evidence), LoadPrior::Flat, effort, &mut random).map_err(|error| error.to_string())?;
    let summary = Summary::new(&found);
    let statements = [0, 1, 2].map(|target| statement(&summary, target));
    Ok(Finding { remarks: unconverged(&summary).into_iter().collect(), ..Finding::of(statements) })
}

/// What is said where the chains have not come together within the effort.
fn unconverged(summary: &Summary) -> Option<String> {
    (!summary.converged).then(|| {
        format!(
            "the sampler's chains have not come together (split-R̂ {:.2}, {:.0} independent draws): mean and intervals are rough",
            summary.split_r_hat, summary.effective_size
        )
    })
}

fn statement(summary: &Summary, target: usize) -> Statement {
    let logarithmic = target != 1;
    let unit = |value: f64| if logarithmic { value.exp() } else { value };
    let values = sorted(summary.draws.iter().map(|draw: &Targets| draw[target]));
    let at = |share: f64| quantile(&values, share);
    let (mean, std) = (summary.targets[target].mean, summary.targets[target].std);
    let prior = f64::from(crate::train::dataset::prior_scale().std[target]);
    Statement {
        value: unit(mean),
        std: if logarithmic { log_normal_std(mean, std) } else { std },
        interval_68: [0.16, 0.84].map(|share| unit(at(share))),
        interval_95: [0.025, 0.975].map(|share| unit(at(share))),
        identifiable: is_told(std, prior) && summary.converged,
        assumed: false,
    }
}
