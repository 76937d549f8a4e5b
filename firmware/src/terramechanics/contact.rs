//! Where the rim touches the soil.

use crate::scalar::Scalar;

use super::{Soil, Wheel};

/// The contact angles on the rim, rad, from the downward vertical and positive forward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact<S> {
    /// Entry angle θ₁ > 0, equation 9.
    pub entry_rad: S,
    /// Angle of the peak stress θm, equation 10.
    pub peak_rad: S,
    /// Exit angle θ₂ ≤ 0, equation 11.
    pub exit_rad: S,
}

impl<S: Scalar> Contact<S> {
    /// The contact of a wheel at the given slip and sinkage (m), equations 9–11.
    pub fn new(wheel: &Wheel<S>, soil: &Soil<S>, slip: S, sinkage_m: S) -> Self {
        let depth = sinkage_m / wheel.radius_m;
        let entry_rad = (S::one() - depth).acos();
        let exit_rad = -(S::one() - soil.rebound_ratio * depth).acos();
        let peak_rad = (soil.peak_stress_c1 + soil.peak_stress_c2 * slip) * entry_rad;
        let guard = S::constant(1e-3) * (entry_rad - exit_rad);
        Self { entry_rad, peak_rad: peak_rad.max(exit_rad + guard).min(entry_rad - guard), exit_rad }
    }
}
