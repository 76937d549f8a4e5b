//! Grousers that shear the soil deeper than the rim, or push it as blades.

use crate::scalar::Scalar;

use super::info::effect_parameters;
use super::{Circumstances, Column, Effect, Form, ShearConditions, WheelTruth};
use crate::terramechanics::Contact;

effect_parameters! {
    /// Grousers of height h act in one of two ways:
    ///
    /// - the soil shears at r + λ h instead of r (Ding et al. 2009, IROS, 4122–4127);
    /// - each of the N_g (θ₁ − θ₂)/2π grousers in the soil meets Rankine's passive pressure
    ///   b (γh²N_φ/2 + 2ch√N_φ + qhN_φ), q the mean pressure W/(rb(θ₁ − θ₂)) of the contact, times a share; it pushes the
    ///   wheel forward and takes its torque at r + h/2.
    pub struct GrouserThrust {
        /// λ.
        shear_height_share: "lambda" ["-"] = 0.0, 0.0 to 2.0, about 0.6;
        /// Share of the passive pressure of the blades.
        blade_share: "blade" ["-"] = 0.0, 0.0 to 4.0, about 0.5;
    }
}

impl<S: Scalar> Effect<S> for GrouserThrust<S> {
    const ID: &'static str = "grouser-thrust";
    const SUMMARY: &'static str = "the grousers add thrust";
    const TEST: &'static str = "the same wheel with its grousers taped over or taken off";
    const FORMS: &'static [Form] = &[
        Form { name: "shear radius", free: &["lambda"], set: &[], needs: &[Column::Grousers] },
        Form { name: "blades", free: &["blade"], set: &[], needs: &[Column::Grousers] },
    ];
    const FOLLOWS_LOAD: bool = true;

    fn shear(&self, shear: &mut ShearConditions<S>, at: &Circumstances<'_, S>) {
        let height = at.grousers.height_m / at.wheel.radius_m;
        shear.radius_ratio = Some(S::one() + self.shear_height_share * height);
    }

    fn resist(&self, truth: &mut WheelTruth<S>, contact: &Contact<S>, at: &Circumstances<'_, S>) {
        let (height, width) = (at.grousers.height_m, at.wheel.width_m);
        let passive = at.passive_coefficient();
        let half = S::constant(0.5);
        let line_n_m = half * at.unit_weight_n_m3() * height * height * passive
            + S::constant(2.0) * at.soil.cohesion_pa * height * passive.sqrt();
        let per_rad = at.grousers.count * S::constant(0.5 * core::f64::consts::FRAC_1_PI);
        // That of the mean pressure, W/(r b span), over all blades in the span: which may be none at all.
        let of_load_n = at.load_n * height * passive * per_rad / at.wheel.radius_m;
        let thrust_n = self.blade_share * (width * line_n_m * per_rad * contact.span_rad() + of_load_n);
        truth.drawbar_pull_n += thrust_n;
        truth.torque_nm += thrust_n * (at.wheel.radius_m + half * height);
    }
}
