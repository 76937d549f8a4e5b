//! The soil of a bank that explains drawbar pull and torque best, without sinkage: the Bayesian multiple-model step of Ray
//! (SPIE 6962, 2008; IEEE Transactions on Robotics 25(3):717–726, 2009). A reconstruction: the papers were not at hand.
//!
//! Each soil of the bank is a hypothesis. It says at which sinkage it would carry the wheel's load, and from that what
//! drawbar pull and torque would be; how likely the measured ones are then moves its probability by Bayes' rule:
//! p_j(k) ∝ p(y_k | H_j) p_j(k − 1). The answer is the mean and the spread of the bank's soils under these probabilities.
//!
//! Ours beside that: what the noise of slip and load does to the prediction is taken in, straightened at the measured slip
//! and load; and a hypothesis is tested against the data (χ²), since the likeliest soil of a bank need not be a likely one.

mod likelihood;
mod multiple_model;
mod posterior;

pub use multiple_model::MultipleModel;

use crate::scalar::Scalar;
use crate::terramechanics::{Soil, Wheel};

use super::{Identified, Observation, Refusal};

/// Soils that the bank of [`ray`] can hold.
pub const BANK: usize = 64;

/// Identifies the soil of all observations at once, each soil of the bank being as likely as any other beforehand:
/// [`MultipleModel`] with a single update.
///
/// # Errors
/// As [`MultipleModel::new`] and [`MultipleModel::update`].
pub fn ray<S: Scalar>(
    wheel: &Wheel<S>,
    observations: &[Observation<S>],
    bank: &[Soil<S>],
) -> Result<Identified<S>, Refusal> {
    MultipleModel::<S, BANK>::new(bank)?.update(wheel, observations)
}
