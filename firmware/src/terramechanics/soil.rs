//! The parameters of a soil.

use crate::scalar::Scalar;

/// A homogeneous soil as the wheel–soil equations see it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Soil<S> {
    /// Sinkage exponent n (dimensionless), equation 6.
    pub sinkage_exponent: S,
    /// Cohesive modulus k_c, Pa/m^(n−1), equation 6.
    pub cohesive_modulus: S,
    /// Frictional modulus k_φ, Pa/m^n, equation 6.
    pub frictional_modulus: S,
    /// Cohesion c, Pa, equation 1.
    pub cohesion_pa: S,
    /// Angle of internal friction φ, rad, equation 1.
    pub friction_angle_rad: S,
    /// Shear deformation modulus K, m, equation 1.
    pub shear_modulus_m: S,
    /// Position of the peak stress at zero slip, c₁ of equation 10.
    pub peak_stress_c1: S,
    /// Shift of the peak stress with slip, c₂ of equation 10.
    pub peak_stress_c2: S,
    /// Share of the sinkage that rises behind the wheel, η of equation 11; 0 = no rear contact.
    pub rebound_ratio: S,
}

impl<S> Soil<S> {
    /// The same soil in another scalar.
    pub fn map<T>(self, convert: impl Fn(S) -> T) -> Soil<T> {
        Soil {
            sinkage_exponent: convert(self.sinkage_exponent),
            cohesive_modulus: convert(self.cohesive_modulus),
            frictional_modulus: convert(self.frictional_modulus),
            cohesion_pa: convert(self.cohesion_pa),
            friction_angle_rad: convert(self.friction_angle_rad),
            shear_modulus_m: convert(self.shear_modulus_m),
            peak_stress_c1: convert(self.peak_stress_c1),
            peak_stress_c2: convert(self.peak_stress_c2),
            rebound_ratio: convert(self.rebound_ratio),
        }
    }
}

impl<S: Scalar> Soil<S> {
    /// Stiffness k_c / b + k_φ under a wheel of the given width, Pa/m^n.
    pub fn stiffness(&self, width_m: S) -> S {
        self.cohesive_modulus / width_m + self.frictional_modulus
    }

    /// Makes the soil stiffer by a factor.
    pub fn scale_stiffness(&mut self, factor: S) {
        self.cohesive_modulus = self.cohesive_modulus * factor;
        self.frictional_modulus = self.frictional_modulus * factor;
    }

    /// Makes cohesion and tan φ greater by a factor.
    pub fn scale_strength(&mut self, factor: S) {
        let (sin, cos) = self.friction_angle_rad.sin_cos();
        let tan = factor * sin / cos;
        self.friction_angle_rad = angle_of_tangent(tan);
        self.cohesion_pa = self.cohesion_pa * factor;
    }

    /// Every parameter is a number, and those whose sign or size the equations rest on are in range: n ≥ 0, K ≥ 0,
    /// |φ| < π/2, 0 ≤ η ≤ 1. Moduli and cohesion of a fit may be negative, and the equations take them as they are.
    pub fn is_valid(&self) -> bool {
        let finite = [
            self.cohesive_modulus,
            self.frictional_modulus,
            self.cohesion_pa,
            self.sinkage_exponent,
            self.shear_modulus_m,
            self.peak_stress_c1,
            self.peak_stress_c2,
        ];
        finite.iter().all(|parameter| parameter.plain().is_finite())
            && self.sinkage_exponent >= S::zero()
            && self.shear_modulus_m >= S::zero()
            && self.friction_angle_rad.abs() < S::constant(core::f64::consts::FRAC_PI_2)
            && self.rebound_ratio >= S::zero()
            && self.rebound_ratio <= S::one()
    }
}

/// The angle (rad) of a tangent, of its sign: the arc cosine of the cosine, as the scalar has no arc tangent.
pub(crate) fn angle_of_tangent<S: Scalar>(tangent: S) -> S {
    let angle = (S::one() / (S::one() + tangent * tangent).sqrt()).acos();
    if tangent < S::zero() { -angle } else { angle }
}
