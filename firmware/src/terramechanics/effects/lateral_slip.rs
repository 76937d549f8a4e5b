//! A wheel that moves at an angle to its plane.

use crate::scalar::Scalar;

use super::info::effect_parameters;
use super::{Circumstances, Column, Effect, Form, ShearConditions, WheelTruth};
use crate::terramechanics::Contact;

effect_parameters! {
    /// At a slip angle β the soil shears sideways as well, j_y = r (1 − i)(θ₁ − θ) tan β, and the stress lies along the
    /// combined displacement √(j_x² + j_y²) (Pavlov and Johnson's public wheel model); the side of the wheel pushes soil, with
    /// R = D₁ (c z + D₂ γ z²/2) per length of contact, D₁ = cot X + tan(X + φ), D₂ = cot X + cot²X/cot φ, X = 45° − φ/2
    /// (Ishigami et al. 2007). The side force has the sign of the slip angle.
    pub struct LateralSlip {
        /// Factor on tan β; 1 is the equation.
        shear_share: "shear" ["-"] = 0.0, 0.0 to 2.5, about 1.0;
        /// Factor on the side's pushing; 1 is the equation.
        bulldozing_share: "bulldozing" ["-"] = 0.0, 0.0 to 4.0, about 1.0;
    }
}

impl<S: Scalar> Effect<S> for LateralSlip<S> {
    const ID: &'static str = "lateral-slip";
    const SUMMARY: &'static str = "the wheel slides sideways";
    const TEST: &'static str = "runs at the opposite slip angle and at none";
    const FORMS: &'static [Form] = &[
        Form { name: "shear", free: &["shear"], set: &[], needs: &[Column::SlipAngle] },
        Form { name: "shear and side", free: &["shear", "bulldozing"], set: &[], needs: &[Column::SlipAngle] },
    ];

    fn shear(&self, shear: &mut ShearConditions<S>, at: &Circumstances<'_, S>) {
        if let Some(angle) = at.conditions.slip_angle_rad {
            let (sin, cos) = angle.sin_cos();
            shear.tan_slip_angle = Some(self.shear_share * sin / cos.max(S::constant(0.05)));
        }
    }

    fn resist(&self, truth: &mut WheelTruth<S>, contact: &Contact<S>, at: &Circumstances<'_, S>) {
        let Some(angle) = at.conditions.slip_angle_rad.filter(|angle| angle.abs() > S::zero()) else {
            return;
        };
        let friction = at.soil.friction_angle_rad.max(S::constant(0.02));
        let wedge = S::constant(core::f64::consts::FRAC_PI_4) - S::constant(0.5) * friction;
        let tangent = |angle: S| angle.sin() / angle.cos();
        let cotangent = S::one() / tangent(wedge);
        let first = cotangent + tangent(wedge + friction);
        let second = cotangent + cotangent * cotangent * tangent(friction);
        let depth = truth.sinkage_m;
        let weight = S::constant(0.5) * second * at.unit_weight_n_m3() * depth * depth;
        let line_n_m = first * (at.soil.cohesion_pa * depth + weight);
        let side_n = self.bulldozing_share * line_n_m * at.wheel.radius_m * contact.entry_rad.sin();
        truth.side_force_n += if angle < S::zero() { -side_n } else { side_n };
    }
}
