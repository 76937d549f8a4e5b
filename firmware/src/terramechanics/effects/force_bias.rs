//! A force channel with an offset.

use crate::scalar::Scalar;

use super::info::effect_parameters;
use super::{Circumstances, Column, Effect, Form, Memory, Readings, WheelTruth};

effect_parameters! {
    /// A constant added to a force channel.
    pub struct ForceBias {
        /// Offset of the drawbar pull, N.
        drawbar_pull_n: "drawbar_pull_n" ["N"] = 0.0, -500.0 to 500.0, about 1.0;
        /// Offset of the load, N.
        load_n: "load_n" ["N"] = 0.0, -500.0 to 500.0, about 1.0;
        /// Offset of the side force, N.
        side_force_n: "side_force_n" ["N"] = 0.0, -500.0 to 500.0, about 1.0;
    }
}

impl<S: Scalar> Effect<S> for ForceBias<S> {
    const ID: &'static str = "force-bias";
    const SUMMARY: &'static str = "a force channel has an offset";
    const TEST: &'static str = "the force sensors with the wheel in the air";
    const FORMS: &'static [Form] = &[
        Form { name: "drawbar pull", free: &["drawbar_pull_n"], set: &[], needs: &[Column::DrawbarPull] },
        Form { name: "load", free: &["load_n"], set: &[], needs: &[Column::Load] },
        Form { name: "side force", free: &["side_force_n"], set: &[], needs: &[Column::SideForce] },
    ];
    const ANY_SIZE: bool = true;

    fn read(&self, readings: &mut Readings<S>, _truth: &WheelTruth<S>, _at: &Circumstances<'_, S>, _: &mut Memory<S>) {
        readings.drawbar_pull_n += self.drawbar_pull_n;
        readings.load_n += self.load_n;
        readings.side_force_n += self.side_force_n;
    }
}
