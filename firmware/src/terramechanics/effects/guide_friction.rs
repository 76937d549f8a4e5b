//! Load that is lost in a guide.

use crate::scalar::Scalar;

use super::info::effect_parameters;
use super::{Circumstances, Column, Effect, Form, Memory, Readings, WheelTruth, Words};

effect_parameters! {
    /// W read = W − μ |DP|: a vertical guide under a horizontal force holds back load in proportion to its size. With a
    /// negative μ the loss is on the wheel's side of what reads the load.
    pub struct GuideFriction {
        /// μ.
        coefficient: "mu" ["-"] = 0.0, -0.9 to 0.9, about 0.1;
    }
}

impl<S: Scalar> Effect<S> for GuideFriction<S> {
    const ID: &'static str = "guide-friction";
    const SUMMARY: &'static str = "the load read depends on the horizontal force";
    const WORDS: &'static [Words] = &[Words {
        parameter: "mu",
        above: "load is lost in a guide as the horizontal force grows",
        below: "the load read grows with the horizontal force, which no friction does",
    }];
    const TEST: &'static str = "a horizontal force on the standing wheel, to both sides";
    const FORMS: &'static [Form] =
        &[Form { name: "load", free: &["mu"], set: &[], needs: &[Column::Load, Column::DrawbarPull] }];
    const ANY_SIZE: bool = true;

    fn read(&self, readings: &mut Readings<S>, truth: &WheelTruth<S>, _at: &Circumstances<'_, S>, _: &mut Memory<S>) {
        readings.load_n += -(self.coefficient * truth.drawbar_pull_n.abs());
    }
}
