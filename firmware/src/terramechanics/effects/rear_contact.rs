//! Soil that rises behind the wheel and pushes.

use crate::scalar::Scalar;
use crate::terramechanics::{Contact, Soil};

use super::info::effect_parameters;
use super::{Circumstances, Effect, Form};

effect_parameters! {
    /// The contact reaches behind the lowest point: θ₂ = −arccos(1 − η z/r) (equation 11 with η above the soil's own) or
    /// θ₂ = −c₃ θ₁ (Ding et al. 2009).
    pub struct RearContact {
        /// What is added to η.
        rebound: "eta" ["-"] = 0.0, 0.0 to 0.8, about 0.1;
        /// c₃.
        entry_share: "c3" ["-"] = 0.0, 0.0 to 0.9, about 0.3;
    }
}

impl<S: Scalar> Effect<S> for RearContact<S> {
    const ID: &'static str = "rear-contact";
    const SUMMARY: &'static str = "the soil rises behind the wheel";
    const TEST: &'static str = "the rut behind the wheel, or the wheel on a hard floor, where it vanishes";
    const FORMS: &'static [Form] = &[
        Form { name: "rebound", free: &["eta"], set: &[], needs: &[] },
        Form { name: "share of entry angle", free: &["c3"], set: &[], needs: &[] },
    ];

    fn soil(&self, soil: &mut Soil<S>, _at: &Circumstances<'_, S>) {
        soil.rebound_ratio = (soil.rebound_ratio + self.rebound).min(S::one());
    }

    fn contact(&self, contact: &mut Contact<S>, _at: &Circumstances<'_, S>) {
        contact.exit_rad += -(self.entry_share * contact.entry_rad);
    }
}
