//! The geometry of a wheel.

use serde::{Deserialize, Serialize};

/// A rigid wheel. Grousers act only through an effect; equations 1–11 use the radius alone.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Wheel<S> {
    /// Radius r, m.
    pub radius_m: S,
    /// Width b, m.
    pub width_m: S,
}
