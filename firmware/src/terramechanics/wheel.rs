//! The geometry of a wheel.

use serde::{Deserialize, Serialize};

use crate::scalar::Scalar;

/// A rigid wheel. Grousers act only through an effect; equations 1–11 use the radius alone.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Wheel<S> {
    /// Radius r, m.
    pub radius_m: S,
    /// Width b, m.
    pub width_m: S,
}

impl<S> Wheel<S> {
    /// The same wheel in another scalar.
    pub fn map<T>(self, convert: impl Fn(S) -> T) -> Wheel<T> {
        Wheel { radius_m: convert(self.radius_m), width_m: convert(self.width_m) }
    }
}

impl<S: Scalar> Wheel<S> {
    /// Radius and width are numbers above zero.
    pub fn is_valid(&self) -> bool {
        [self.radius_m, self.width_m].iter().all(|length| *length > S::zero() && length.is_finite())
    }
}
