//! What one may ask of a fit.

use thiserror::Error;

use super::observation::{CHANNELS, Reading};

/// Standard deviation τ of a channel's run offsets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OffsetStd {
    /// The rows of a run share no offset.
    None,
    /// Known, in the channel's unit, > 0.
    Known(f64),
    /// Estimated from the data.
    Estimated,
}

/// What the standard deviations of offsets and noise are estimated by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VarianceCriterion {
    /// Maximum likelihood at the fitted parameters: comparable between models, too small by the share of the parameters.
    MaximumLikelihood,
    /// Restricted maximum likelihood (Patterson & Thompson 1971, Biometrika 58:545): the parameters are integrated out too, so
    /// that what they absorb is not missing from the variances.
    Restricted,
}

/// How a fit is done.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Standardised residual beyond which Huber's loss grows linearly, > 0; ∞ for squares.
    pub huber: f64,
    /// Offsets that the rows of a run share, by channel.
    pub offsets: [OffsetStd; CHANNELS],
    /// Rows that a run must have to have offsets of its own, ≥ 1.
    pub smallest_run_with_offset: usize,
    /// Channels whose noise is not stated: one factor on the noise of all its readings is estimated.
    pub estimate_noise: [bool; CHANNELS],
    /// What these are estimated by.
    pub variance_criterion: VarianceCriterion,
    /// What a true slip can be.
    pub slip_range: (f64, f64),
    /// What a true load can be, N.
    pub load_range_n: (f64, f64),
    /// Standard deviations of the prior of slip and of load (N) about their start: wide enough not to matter wherever a reading
    /// says anything.
    pub latent_prior_std: [f64; 2],
    /// Most Levenberg–Marquardt steps.
    pub most_iterations: usize,
    /// A step that lowers the objective (half a sum of squares in units of noise) by less than this is the last.
    pub tolerance: f64,
    /// Whether runs are predicted in parallel. Neither value changes a result.
    pub parallel: bool,
}

impl Default for Options {
    fn default() -> Self {
        let judged = |channel: usize| Reading::JUDGED.iter().any(|reading| reading.index() == channel);
        Self {
            huber: 3.0,
            offsets: std::array::from_fn(|c| if judged(c) { OffsetStd::Estimated } else { OffsetStd::None }),
            smallest_run_with_offset: 2,
            estimate_noise: [false; CHANNELS],
            variance_criterion: VarianceCriterion::Restricted,
            slip_range: (-1.0, 1.0),
            load_range_n: (0.0, f64::INFINITY),
            latent_prior_std: [10.0, 1e4],
            most_iterations: 60,
            tolerance: 1e-6,
            parallel: true,
        }
    }
}

/// Why there is no fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum FitError {
    /// No row is left to fit.
    #[error("there is no row to fit")]
    NoRows,
    /// A reading or its noise is not a number, or the noise is not positive.
    #[error("row {row} holds a reading or a noise that is not finite, or a noise that is not positive")]
    UnsoundRow {
        /// Index of the row.
        row: usize,
    },
    /// A start has not one finite value per coordinate and one latent per row.
    #[error("the start does not fit the model's coordinates and rows")]
    UnfitStart,
    /// The model predicts nothing at the start, nor on the way from there to the middle of the prior.
    #[error("the model has no prediction at the start, nor on the way to the middle of the prior")]
    NoPrediction,
    /// There was no start to begin from.
    #[error("there is no start")]
    NoStart,
}
