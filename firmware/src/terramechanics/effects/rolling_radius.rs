//! A slip with a wrong radius or velocity scale.

use crate::scalar::Scalar;

use super::info::effect_parameters;
use super::{Circumstances, Effect, Form, Memory, Readings, WheelTruth};

effect_parameters! {
    /// The slip is computed with a rolling radius that is 1 + ε times the true one (or with a speed that is as much too
    /// small): v/(rω) read = v/(rω)/(1 + ε).
    pub struct RollingRadius {
        /// ε.
        excess: "excess" ["-"] = 0.0, -0.4 to 0.4, about 0.03;
    }
}

impl<S: Scalar> Effect<S> for RollingRadius<S> {
    const ID: &'static str = "rolling-radius";
    const SUMMARY: &'static str = "the slip is computed with a wrong radius or speed";
    const TEST: &'static str = "the way of ten turns on a hard floor";
    const FORMS: &'static [Form] = &[Form { name: "radius", free: &["excess"], set: &[], needs: &[] }];

    fn read(&self, readings: &mut Readings<S>, _truth: &WheelTruth<S>, _at: &Circumstances<'_, S>, _: &mut Memory<S>) {
        let scale = S::one() + self.excess;
        // rω/v read is `scale` times the true one: below one the wheel is read as braking.
        readings.slip = if readings.slip < S::zero() {
            let ratio = (S::one() + readings.slip) * scale;
            if ratio < S::one() { ratio - S::one() } else { S::one() - S::one() / ratio }
        } else {
            let ratio = (S::one() - readings.slip) / scale;
            if ratio > S::one() { S::one() / ratio - S::one() } else { S::one() - ratio }
        };
    }
}
