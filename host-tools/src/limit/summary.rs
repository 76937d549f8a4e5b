//! What the posterior says of an observation: mean, spread, and how well sampling knows them.

use kapvik_firmware::wheel_state::SoilQuery;
use rand::RngExt;
use thiserror::Error;

use super::coordinates::{DIMENSION, Targets, targets_at};
use super::diagnostics::Diagnosis;
use super::mode::mode;
use super::posterior::SoilPosterior;
use super::sampler::{Draws, Effort, sample};
use super::straight::Straightened;
use super::student::Student;
use super::wheel_likelihood::LoadPrior;

/// Enough for a mean whose Monte-Carlo variance is below 1/200 of the posterior's.
pub const EFFORT: Effort = Effort {
    chains: 8,
    rounds: 1,
    round_steps: 12,
    batch_steps: 20,
    effective_size: 200.0,
    split_r_hat: 1.05,
    batches: 60,
};

/// The posterior of ln c, φ and ln K.
#[derive(Debug, Clone)]
pub struct Summary {
    /// Diagnosis of each; its mean is the estimate that no other can beat.
    pub targets: [Diagnosis; 3],
    /// Draws of each.
    pub draws: Vec<Targets>,
    /// Greatest split-R̂ of the seven coordinates.
    pub split_r_hat: f64,
    /// Least effective sample size of the seven coordinates.
    pub effective_size: f64,
    /// Whether both reached what was asked.
    pub converged: bool,
    /// Evaluations of the density.
    pub evaluations: usize,
}

/// Why there is no posterior to tell of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum NoPosterior {
    /// The middle of the prior cannot be evaluated.
    #[error("the soil in the middle of the prior cannot carry the wheels")]
    Mode,
    /// No chain could be started.
    #[error("no soil near the mode of the posterior has any density")]
    Start,
}

/// Draws of the posterior of an observation.
///
/// # Errors
/// Where the observation is so far from the prior that there is no posterior to sample.
pub fn draws(
    query: &SoilQuery,
    load: LoadPrior,
    effort: &Effort,
    random: &mut impl RngExt,
) -> Result<Draws<DIMENSION>, NoPosterior> {
    let posterior = SoilPosterior::new(query, load);
    let mode = mode(&posterior).ok_or(NoPosterior::Mode)?;
    let straightened = Straightened::new(&posterior, &mode);
    let place = straightened.place(mode);
    sample(&straightened, Student::standard(), &place, effort, random).ok_or(NoPosterior::Start)
}

impl Summary {
    /// Of draws of the coordinates.
    pub fn new(draws: &Draws<DIMENSION>) -> Self {
        let axes: [Diagnosis; DIMENSION] = std::array::from_fn(|axis| draws.diagnose(|point| point[axis]));
        Self {
            targets: std::array::from_fn(|k| draws.diagnose(|point| targets_at(point)[k])),
            draws: draws.iter().map(targets_at).collect(),
            split_r_hat: axes.iter().map(|axis| axis.split_r_hat).fold(1.0, f64::max),
            effective_size: axes.iter().map(|axis| axis.effective_size).fold(f64::INFINITY, f64::min),
            converged: draws.converged,
            evaluations: draws.evaluations,
        }
    }

    /// Posterior means.
    pub fn means(&self) -> Targets {
        self.targets.map(|target| target.mean)
    }

    /// Share of the posterior below `truth`.
    pub fn ranks(&self, truth: &Targets) -> Targets {
        let count = self.draws.len() as f64;
        std::array::from_fn(|k| self.draws.iter().filter(|draw| draw[k] < truth[k]).count() as f64 / count)
    }
}
