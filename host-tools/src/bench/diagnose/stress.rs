//! Equations 3–11 with another shear stress: a plain integral, slow and open to any law.

use kapvik_firmware::terramechanics::{Contact, WheelForces};

use super::overlay::Place;

/// A point on the rim.
#[derive(Debug, Clone, Copy)]
pub struct StressPoint {
    /// Normal stress σ, Pa.
    pub normal_pa: f64,
    /// Shear displacement j, m.
    pub displacement_m: f64,
}

/// Intervals of Simpson's rule on each side of the peak stress.
const INTERVALS: usize = 48;

/// Forces at a place, with `shear_pa` in place of equation 1. For driving wheels: slip from 0 to 1.
///
/// Angles are spaced by 3u² − 2u³ on each side of the peak, closely where the stress starts and ends as a power.
pub fn integrate(place: &Place<'_>, shear_pa: impl Fn(&StressPoint) -> f64) -> WheelForces<f64> {
    let (wheel, soil) = (&place.site.wheel, &place.site.soil);
    let contact = Contact::new(wheel, soil, place.slip, place.sinkage_m);
    let stiffness = soil.stiffness(wheel.width_m);
    let mut forces = WheelForces { drawbar_pull_n: 0.0, load_n: 0.0, torque_nm: 0.0 };
    for (end_rad, length_rad) in [
        (contact.entry_rad, contact.peak_rad - contact.entry_rad),
        (contact.exit_rad, contact.peak_rad - contact.exit_rad),
    ] {
        for node in 0..=INTERVALS {
            let u = node as f64 / INTERVALS as f64;
            let share = u * u * (3.0 - 2.0 * u);
            let angle_rad = end_rad + length_rad * share;
            // Equation 8: behind the peak the stress is that of the angle in front with the same share of its side.
            let front_rad = contact.entry_rad + (contact.peak_rad - contact.entry_rad) * share;
            let depth_m = wheel.radius_m * (libm::cos(front_rad) - libm::cos(contact.entry_rad)).max(0.0);
            let ground = 1.0 - place.slip;
            let displacement_m = wheel.radius_m
                * ((contact.entry_rad - angle_rad) - ground * (libm::sin(contact.entry_rad) - libm::sin(angle_rad)));
            let normal_pa = stiffness * libm::pow(depth_m, soil.sinkage_exponent);
            let tau_pa = shear_pa(&StressPoint { normal_pa, displacement_m: displacement_m.max(0.0) });
            let simpson = match node {
                0 | INTERVALS => 1.0,
                odd if odd % 2 == 1 => 4.0,
                _ => 2.0,
            } / (3.0 * INTERVALS as f64);
            let weight = simpson * length_rad.abs() * 6.0 * u * (1.0 - u) * wheel.radius_m * wheel.width_m;
            let (sin, cos) = libm::sincos(angle_rad);
            forces.drawbar_pull_n += weight * (tau_pa * cos - normal_pa * sin);
            forces.load_n += weight * (normal_pa * cos + tau_pa * sin);
            forces.torque_nm += weight * tau_pa * wheel.radius_m;
        }
    }
    forces
}

/// Equation 1 at a point.
pub fn janosi_hanamoto_pa(place: &Place<'_>, point: &StressPoint) -> f64 {
    let soil = &place.site.soil;
    let mobilised = 1.0 - libm::exp(-point.displacement_m / soil.shear_modulus_m);
    strength_pa(place, point) * mobilised
}

/// Coulomb's strength c + σ tan φ at a point, Pa.
pub fn strength_pa(place: &Place<'_>, point: &StressPoint) -> f64 {
    let soil = &place.site.soil;
    soil.cohesion_pa + point.normal_pa * libm::tan(soil.friction_angle_rad)
}
