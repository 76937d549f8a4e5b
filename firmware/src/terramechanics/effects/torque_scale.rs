//! A torque channel with a gain error.

use crate::scalar::Scalar;

use super::info::effect_parameters;
use super::{Circumstances, Column, Effect, Form, Memory, Readings, WheelTruth};

effect_parameters! {
    /// T read = (1 + g) T.
    pub struct TorqueScale {
        /// g.
        gain_error: "gain" ["-"] = 0.0, -0.6 to 1.0, about 0.05;
    }
}

impl<S: Scalar> Effect<S> for TorqueScale<S> {
    const ID: &'static str = "torque-scale";
    const SUMMARY: &'static str = "the torque channel has a gain error";
    const TEST: &'static str = "a known torque on the wheel: a weight on a lever";
    const FORMS: &'static [Form] = &[Form { name: "gain", free: &["gain"], set: &[], needs: &[Column::Torque] }];
    const ANY_SIZE: bool = true;

    fn read(&self, readings: &mut Readings<S>, _truth: &WheelTruth<S>, _at: &Circumstances<'_, S>, _: &mut Memory<S>) {
        readings.torque_nm = readings.torque_nm * (S::one() + self.gain_error);
    }
}
