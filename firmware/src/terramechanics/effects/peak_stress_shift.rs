//! A peak of the normal stress elsewhere than declared.

use crate::scalar::Scalar;
use crate::terramechanics::Contact;

use super::info::effect_parameters;
use super::{Circumstances, Effect, Form};

effect_parameters! {
    /// θm = (c₁ + Δ₁ + (c₂ + Δ₂) i) θ₁: equation 10 with other coefficients than the declared ones.
    pub struct PeakStressShift {
        /// Δ₁.
        shift: "shift" ["-"] = 0.0, -0.6 to 0.6, about 0.1;
        /// Δ₂.
        per_slip: "per_slip" ["-"] = 0.0, -1.5 to 1.5, about 0.2;
    }
}

impl<S: Scalar> Effect<S> for PeakStressShift<S> {
    const ID: &'static str = "peak-stress-shift";
    const SUMMARY: &'static str = "the normal stress peaks elsewhere than declared";
    const TEST: &'static str = "a pressure sensor in the rim, or runs at slips further apart";
    const FORMS: &'static [Form] = &[
        Form { name: "constant", free: &["shift"], set: &[], needs: &[] },
        Form { name: "with slip", free: &["per_slip"], set: &[], needs: &[] },
        Form { name: "constant and with slip", free: &["shift", "per_slip"], set: &[], needs: &[] },
    ];

    fn contact(&self, contact: &mut Contact<S>, at: &Circumstances<'_, S>) {
        contact.peak_rad += (self.shift + self.per_slip * at.slip) * contact.entry_rad;
    }
}
