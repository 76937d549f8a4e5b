//! What every filter is asked to do.

use kapvik_firmware::filter::trial::{self, Arithmetic, Scales};

/// A filter at work: a prediction and, where there are measurements, an update. Built anew for each run.
pub trait Contender<const N: usize, const M: usize> {
    /// A filter of the given scales, its mean at zero.
    fn start(scales: &Scales) -> Self;
    /// One step.
    fn step(&mut self, measured: Option<&[f32; M]>) -> Answer<N>;
}

/// What a filter says after a step.
pub struct Answer<const N: usize> {
    /// The mean of its states.
    pub mean: [f32; N],
    /// Whether it said of a measurement, or of itself, that something was wrong.
    pub told: bool,
    /// Whether it said that the step failed.
    pub failed: bool,
}

/// The process model: the trial's, or none where the states only drift.
#[inline]
pub fn process<T: Arithmetic, const N: usize, const DRIFT: bool>(constant: impl Fn(f64) -> T, x: &[T; N]) -> [T; N] {
    if DRIFT { *x } else { trial::process_in(constant, x) }
}

/// The spread of the sigma points that every filter is set to: α = 1, β = 2, κ = 0. The default of two of them, α = 0.001,
/// does not survive single precision.
pub const ALPHA: f32 = 1.0;
/// See [`ALPHA`].
pub const BETA: f32 = 2.0;
/// See [`ALPHA`].
pub const KAPPA: f32 = 0.0;
