//! Fits a model to the rows of a campaign, all of whose channels are measured with error.
//!
//! A reading of channel c in row i of run r is `y = f_c(θ, s_i, W_i) + b_rc + e`: θ the parameters of the fit, s and W the
//! row's true slip and load, which nobody knows (errors in variables), b an offset that the rows of a run share, with
//! `b ~ N(0, τ_c²)`, and e the noise, `e ~ N(0, σ_ic²)` in its bulk, with Huber's loss for its tails. The fit is at the mode of
//! all of these together, by Levenberg–Marquardt steps in which each row's two latents and then each run's offsets are
//! eliminated by Schur complements, so that the matrix to solve has the size of θ alone. What is integrated out goes into the
//! likelihood by Laplace's method: for a linear model without outliers it is the exact marginal one.
//!
//! From the ground up: `observation` and `model` are what a caller brings, `options` what one may ask for; `problem` and
//! `state` hold both together; `row_terms`, `run_sums`, `run_terms` and `normal_equations` are the linear algebra, on `slices`;
//! `bounds` keeps a step in its box; `levenberg_marquardt`, `tempering` and `variances` find the optimum, `outcome` describes it;
//! `leave_out`, `predictor`, `measured_latents` and `predictive` predict runs that a fit has not seen; `multistart` fits from many places.

mod bend;
mod bounds;
mod channel_squares;
mod curvature;
mod held_out;
mod huber;
mod leave_out;
mod levenberg_marquardt;
mod leverage;
mod likelihood;
mod measured_latents;
mod memory;
mod model;
mod multistart;
mod normal_equations;
mod observation;
mod options;
mod outcome;
mod predictive;
mod predictor;
mod problem;
mod row_terms;
mod run_sums;
mod run_terms;
mod slices;
mod start;
mod state;
mod tempering;
mod unseen;
mod variance_share;
mod variances;

#[cfg(test)]
mod tests;

pub use channel_squares::ChannelSquares;
pub use held_out::{HeldOut, HeldOutRow, HeldOutRun};
pub use model::{Coordinate, Derivatives, Latent, Model, Prediction};
pub use multistart::{fit_from_many, scattered_starts};
pub use observation::{CHANNELS, Reading, Row};
pub use options::{FitError, OffsetStd, Options, VarianceCriterion};
pub use outcome::{Fit, RunOffset, fit, fit_without};
pub use predictor::{Predictor, predictor_without};
pub use start::Start;
pub use state::Scales;
