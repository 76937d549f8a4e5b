//! Where a parameter may lie.

use crate::scalar::Scalar;

/// The least and the greatest value that a parameter may take; infinite where there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds<S> {
    /// The least.
    pub low: S,
    /// The greatest.
    pub high: S,
}

impl<S: Scalar> Bounds<S> {
    /// From `low` to `high`.
    pub fn new(low: f64, high: f64) -> Self {
        Self { low: S::constant(low), high: S::constant(high) }
    }

    /// Any number.
    pub fn none() -> Self {
        Self::new(f64::NEG_INFINITY, f64::INFINITY)
    }

    /// The nearest value within.
    pub(in crate::identification) fn hold(&self, value: S) -> S {
        value.max(self.low).min(self.high)
    }

    /// Whether a value lies within and not at an end.
    pub(in crate::identification) fn contains_inside(&self, value: S) -> bool {
        value > self.low && value < self.high
    }
}
