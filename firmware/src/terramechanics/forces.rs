//! Drawbar pull, load and torque at a given slip and sinkage.

use crate::scalar::Scalar;

use super::quadrature::GAUSS_16;
use super::{Contact, Soil, Wheel};

/// What the soil does to a wheel, equations 3–5.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WheelForces<S> {
    /// Drawbar pull DP, N, positive forward.
    pub drawbar_pull_n: S,
    /// Normal load W, N, positive downward on the soil.
    pub load_n: S,
    /// Resistive torque T, N·m, positive when the soil resists forward rotation.
    pub torque_nm: S,
}

/// Why no forces could be computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ForceError {
    /// Slip outside −1 … 1, or not a number.
    Slip,
    /// Sinkage outside 0 … 2r, or not a number.
    Sinkage,
}

/// Drawbar pull, load and torque of a wheel at the given slip and sinkage (m): equations 1–11 of the seed.
///
/// # Errors
/// Where slip or sinkage is outside its range.
pub fn wheel_forces<S: Scalar>(
    wheel: &Wheel<S>,
    soil: &Soil<S>,
    slip: S,
    sinkage_m: S,
) -> Result<WheelForces<S>, ForceError> {
    if !(slip > -S::one() && slip <= S::one()) {
        return Err(ForceError::Slip);
    }
    let r = wheel.radius_m;
    if !(sinkage_m >= S::zero() && sinkage_m < r) {
        return Err(ForceError::Sinkage);
    }
    let contact = Contact::new(wheel, soil, slip, sinkage_m);
    let speed_ratio = if slip >= S::zero() { S::one() - slip } else { S::one() / (S::one() + slip) };
    let (sin_entry, cos_entry) = contact.entry_rad.sin_cos();
    let stiffness = soil.stiffness(wheel.width_m) * r.powf(soil.sinkage_exponent);
    let tan_phi = soil.friction_angle_rad.sin() / soil.friction_angle_rad.cos();
    let mut sum = [S::zero(); 3];
    let front = contact.entry_rad - contact.peak_rad;
    let rear = contact.peak_rad - contact.exit_rad;
    for (region, width) in [(0, front), (1, rear)] {
        for (x, w) in GAUSS_16 {
            for t in [0.5 - 0.5 * x, 0.5 + 0.5 * x] {
                // Nodes crowd at the end where the normal stress vanishes as a power law.
                let u = S::constant(t * t * t);
                let weight = S::constant(1.5 * w * t * t) * width;
                let (theta, mapped) = if region == 0 {
                    let theta = contact.entry_rad - front * u;
                    (theta, theta)
                } else {
                    (contact.exit_rad + rear * u, contact.entry_rad - front * u)
                };
                let (sin, cos) = theta.sin_cos();
                let rise = (mapped.cos() - cos_entry).max(S::zero());
                let sigma = stiffness * rise.powf(soil.sinkage_exponent);
                let j = r * ((contact.entry_rad - theta) - speed_ratio * (sin_entry - sin));
                let mobilised = S::one() - (-(j.abs() / soil.shear_modulus_m)).exp();
                let tau = (soil.cohesion_pa + sigma * tan_phi) * mobilised;
                let tau = if j < S::zero() { -tau } else { tau };
                sum[0] += weight * (tau * cos - sigma * sin);
                sum[1] += weight * (sigma * cos + tau * sin);
                sum[2] += weight * tau;
            }
        }
    }
    let area = r * wheel.width_m;
    Ok(WheelForces { drawbar_pull_n: area * sum[0], load_n: area * sum[1], torque_nm: area * r * sum[2] })
}
