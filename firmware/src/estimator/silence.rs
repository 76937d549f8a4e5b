//! How long a sensor has been silent: for a while it is awaited, then something else is taken for what it would say.

use crate::scalar::Scalar;

/// A sensor that has been silent for so long is not awaited any more, s: between two frames of ten a second, so that rounding decides nothing.
pub(super) const AWAITED_S: f64 = 4.95;

/// The time since a sensor last spoke.
#[derive(Debug, Clone, Copy)]
pub(super) struct Silence<S> {
    lasts_s: S,
}

impl<S: Scalar> Silence<S> {
    /// It has spoken just now, or may be about to.
    pub fn none() -> Self {
        Self { lasts_s: S::zero() }
    }

    /// It has been silent for so long, s, already.
    pub fn of(lasts_s: f64) -> Self {
        Self { lasts_s: S::constant(lasts_s) }
    }

    /// Takes whether it spoke in a frame that is so long, s, after the one before.
    pub fn follow(&mut self, speaks: bool, step_s: S) {
        self.lasts_s = if speaks { S::zero() } else { self.lasts_s + step_s };
    }

    /// Whether the sensor spoke in the last frame.
    pub fn is_over(&self) -> bool {
        self.lasts_s <= S::zero()
    }

    /// Whether it has lasted for so long, s.
    pub fn lasts(&self, so_long_s: f64) -> bool {
        self.lasts_s >= S::constant(so_long_s)
    }
}
