//! A sinkage measured from elsewhere.

use crate::scalar::Scalar;

use super::info::effect_parameters;
use super::{Circumstances, Column, Effect, Form, Memory, Readings, WheelTruth};

effect_parameters! {
    /// A constant added to the sinkage: rut against undisturbed surface, grousers' feet against tips.
    pub struct SinkageReference {
        /// The offset, m.
        offset_m: "offset_m" ["m"] = 0.0, -0.05 to 0.05, about 0.002;
    }
}

impl<S: Scalar> Effect<S> for SinkageReference<S> {
    const ID: &'static str = "sinkage-reference";
    const SUMMARY: &'static str = "the sinkage has an offset";
    const TEST: &'static str = "the sinkage reading on a flat plate on the ground";
    const FORMS: &'static [Form] = &[Form { name: "offset", free: &["offset_m"], set: &[], needs: &[Column::Sinkage] }];

    fn read(&self, readings: &mut Readings<S>, _truth: &WheelTruth<S>, _at: &Circumstances<'_, S>, _: &mut Memory<S>) {
        readings.sinkage_m += self.offset_m;
    }
}
