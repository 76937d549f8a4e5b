//! Standard deviations of methods that give none: the scatter of their answers when the noise is drawn again.
//!
//! B. Efron's parametric bootstrap. Each answer is to the observations with their noise added once more, so that what a
//! method makes of noise shows; a bias that noise gives a method does not.

use kapvik_firmware::identification::Observation;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::statistics::{quantile, sorted};

use super::{Evidence, Finding};

/// Redraws of the noise.
pub const REDRAWS: usize = 200;
/// Share of them that must have an answer.
const LEAST_SHARE: f64 = 0.5;

/// Puts a standard deviation where a finding has none. Where the method refuses half of the redraws it stays infinite.
pub fn complete(finding: &mut Finding, evidence: &Evidence, answer: impl Fn(&Evidence) -> Option<Finding>) {
    if finding.statements().iter().all(|statement| statement.std.is_finite()) {
        return;
    }
    let mut random = ChaCha8Rng::seed_from_u64(0);
    let mut redrawn = || {
        let blurred = |seen: &Observation<f64>| seen.state.blurred(&seen.noise, || StandardNormal.sample(&mut random));
        answer(&evidence.seeing(evidence.observations.iter().map(blurred)))
    };
    let answers: Vec<[f64; 3]> =
        (0..REDRAWS).filter_map(|_| redrawn()).map(|found| found.statements().map(|one| one.value)).collect();
    if (answers.len() as f64) < LEAST_SHARE * REDRAWS as f64 {
        return;
    }
    for (parameter, statement) in finding.statements_mut().into_iter().enumerate() {
        if !statement.std.is_finite() {
            *statement = statement.with_std(half_spread(answers.iter().map(|answer| answer[parameter])));
        }
    }
}

/// Half the distance between the 16th and the 84th percentile: the standard deviation of a normal distribution, and a
/// sober figure for one with outliers.
fn half_spread(values: impl Iterator<Item = f64>) -> f64 {
    let values = sorted(values);
    0.5 * (quantile(&values, 0.841) - quantile(&values, 0.159))
}
