//! Dense soil: shear stress that passes a peak.

use crate::scalar::Scalar;

use super::info::effect_parameters;
use super::{Circumstances, Effect, Form, Hump, ShearConditions};

effect_parameters! {
    /// Peak and residual shear (Wong): mobilised share K_r {1 + [1/(K_r (1 − 1/e)) − 1] e^(1 − j/K)} (1 − e^(−j/K)), which is
    /// one at j = K and K_r at the end; mixed with the seed's 1 − e^(−j/K) where only a part of the soil does it.
    pub struct ShearHump {
        /// Part of the soil that has a peak.
        share: "share" ["-"] = 0.0, 0.0 to 1.5, about 1.0;
        /// K_r: residual over peak.
        residual: "residual" ["-"] = 0.7, 0.1 to 1.0, about 0.7;
    }
}

impl<S: Scalar> Effect<S> for ShearHump<S> {
    const ID: &'static str = "shear-hump";
    const SUMMARY: &'static str = "shear stress passes a peak and falls to a residual";
    const TEST: &'static str = "a shear-box or bevameter test of the soil as prepared, to large displacement";
    const FORMS: &'static [Form] = &[
        Form { name: "residual", free: &["residual"], set: &[("share", 1.0)], needs: &[] },
        Form { name: "share", free: &["share"], set: &[], needs: &[] },
    ];

    fn shear(&self, shear: &mut ShearConditions<S>, _at: &Circumstances<'_, S>) {
        shear.hump = Some(Hump { share: self.share, residual: self.residual });
    }
}
