//! The sinkage at which the soil carries a given load.

use crate::scalar::Scalar;

use super::{Soil, Wheel, wheel_forces};

/// Why no sinkage could be found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SinkageError {
    /// Load or slip is negative, infinite or not a number.
    Input,
    /// The soil does not carry the load at any sinkage up to 0.9 r.
    LoadTooGreat,
}

/// The sinkage (m) at which a wheel at the given slip carries `load_n`, by bisection in 0 … 0.9 r.
///
/// # Errors
/// Where an input is not a number, or the soil cannot carry the load.
pub fn sinkage_for_load<S: Scalar>(wheel: &Wheel<S>, soil: &Soil<S>, slip: S, load_n: S) -> Result<S, SinkageError> {
    let load = |z: S| wheel_forces(wheel, soil, slip, z).map(|f| f.load_n).map_err(|_| SinkageError::Input);
    let (mut low, mut high) = (S::constant(1e-5), S::constant(0.9) * wheel.radius_m);
    if load(high)? < load_n {
        return Err(SinkageError::LoadTooGreat);
    }
    for _ in 0..40 {
        let middle = S::constant(0.5) * (low + high);
        if load(middle)? < load_n {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok(S::constant(0.5) * (low + high))
}
