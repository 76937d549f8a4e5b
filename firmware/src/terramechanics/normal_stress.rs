//! The normal stress under the rim: equations 6–8.

use crate::scalar::Scalar;

use super::{Soil, Wheel};

/// Bekker's pressure law on the rim: σ = (k_c/b + k_φ) rⁿ (cos θ − cos θ₁)ⁿ.
///
/// Behind the peak, equation 8 maps θ to an angle in front of it and takes the stress there; the integration uses that
/// directly and evaluates the stress once for both points.
#[derive(Debug, Clone, Copy)]
pub(super) struct NormalStress<S> {
    /// (k_c/b + k_φ) rⁿ, Pa: the stress at a depth of one radius.
    pub at_one_radius_pa: S,
    /// n.
    pub exponent: S,
}

impl<S: Scalar> NormalStress<S> {
    /// The stress of `soil` under `wheel`.
    pub fn new(wheel: &Wheel<S>, soil: &Soil<S>) -> Self {
        let exponent = soil.sinkage_exponent;
        Self { at_one_radius_pa: soil.stiffness(wheel.width_m) * power(wheel.radius_m, exponent), exponent }
    }

    /// σ, Pa, at a point that is `sunk` radii below the undisturbed surface.
    #[inline(always)]
    pub fn at(&self, sunk: S) -> S {
        self.at_one_radius_pa * power(sunk, self.exponent)
    }
}

/// baseⁿ for a base of zero or more: logarithm and exponential, which is cheaper than a correctly rounded power and as
/// good here (the error is the rounding of n ln base).
#[inline(always)]
fn power<S: Scalar>(base: S, exponent: S) -> S {
    (exponent * base.max(S::constant(1e-30)).ln()).exp()
}
