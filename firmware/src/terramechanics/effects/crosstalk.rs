//! Force channels that leak into one another.

use crate::scalar::Scalar;

use super::info::effect_parameters;
use super::{Circumstances, Column, Effect, Form, Memory, Readings, WheelTruth};

effect_parameters! {
    /// A force channel reads a share of another force, with its sign; load and drawbar pull also a share of the torque over a
    /// length.
    pub struct Crosstalk {
        /// Share of the drawbar pull in the load.
        drawbar_pull_to_load: "drawbar_pull_to_load" ["-"] = 0.0, -1.0 to 1.0, about 0.05;
        /// Share of the load in the drawbar pull.
        load_to_drawbar_pull: "load_to_drawbar_pull" ["-"] = 0.0, -1.0 to 1.0, about 0.05;
        /// Share of the drawbar pull in the side force.
        drawbar_pull_to_side_force: "drawbar_pull_to_side_force" ["-"] = 0.0, -1.0 to 1.0, about 0.05;
        /// Share of the side force in the drawbar pull.
        side_force_to_drawbar_pull: "side_force_to_drawbar_pull" ["-"] = 0.0, -1.0 to 1.0, about 0.05;
        /// Share of the load in the side force.
        load_to_side_force: "load_to_side_force" ["-"] = 0.0, -1.0 to 1.0, about 0.05;
        /// Share of the side force in the load.
        side_force_to_load: "side_force_to_load" ["-"] = 0.0, -1.0 to 1.0, about 0.05;
        /// Load read per torque, N/(N·m).
        torque_to_load_per_m: "torque_to_load_per_m" ["1/m"] = 0.0, -20.0 to 20.0, about 1.0;
        /// Drawbar pull read per torque, N/(N·m).
        torque_to_drawbar_pull_per_m: "torque_to_drawbar_pull_per_m" ["1/m"] = 0.0, -20.0 to 20.0, about 1.0;
    }
}

impl<S: Scalar> Effect<S> for Crosstalk<S> {
    const ID: &'static str = "crosstalk";
    const SUMMARY: &'static str = "one force channel leaks into another";
    const TEST: &'static str = "known forces on the sensor, one axis at a time, and runs at another load";
    const FORMS: &'static [Form] = &[
        Form {
            name: "drawbar pull into load",
            free: &["drawbar_pull_to_load"],
            set: &[],
            needs: &[Column::DrawbarPull, Column::Load],
        },
        Form {
            name: "load into drawbar pull",
            free: &["load_to_drawbar_pull"],
            set: &[],
            needs: &[Column::Load, Column::DrawbarPull],
        },
        Form {
            name: "drawbar pull into side force",
            free: &["drawbar_pull_to_side_force"],
            set: &[],
            needs: &[Column::DrawbarPull, Column::SideForce],
        },
        Form {
            name: "side force into drawbar pull",
            free: &["side_force_to_drawbar_pull"],
            set: &[],
            needs: &[Column::SideForce, Column::DrawbarPull],
        },
        Form {
            name: "load into side force",
            free: &["load_to_side_force"],
            set: &[],
            needs: &[Column::Load, Column::SideForce],
        },
        Form {
            name: "side force into load",
            free: &["side_force_to_load"],
            set: &[],
            needs: &[Column::SideForce, Column::Load],
        },
        Form {
            name: "torque into load",
            free: &["torque_to_load_per_m"],
            set: &[],
            needs: &[Column::Torque, Column::Load],
        },
        Form {
            name: "torque into drawbar pull",
            free: &["torque_to_drawbar_pull_per_m"],
            set: &[],
            needs: &[Column::Torque, Column::DrawbarPull],
        },
    ];
    const ANY_SIZE: bool = true;

    fn read(&self, readings: &mut Readings<S>, truth: &WheelTruth<S>, _at: &Circumstances<'_, S>, _: &mut Memory<S>) {
        let (pull_n, load_n, side_n) = (truth.drawbar_pull_n, truth.load_n, truth.side_force_n);
        readings.load_n += self.drawbar_pull_to_load * pull_n
            + self.side_force_to_load * side_n
            + self.torque_to_load_per_m * truth.torque_nm;
        readings.drawbar_pull_n += self.load_to_drawbar_pull * load_n
            + self.side_force_to_drawbar_pull * side_n
            + self.torque_to_drawbar_pull_per_m * truth.torque_nm;
        readings.side_force_n += self.drawbar_pull_to_side_force * pull_n + self.load_to_side_force * load_n;
    }
}
