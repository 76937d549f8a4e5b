//! A force channel whose offset grows.

use crate::scalar::Scalar;

use super::info::effect_parameters;
use super::saturation::saturated;
use super::{Circumstances, Column, Effect, Form, Memory, Readings, WheelTruth};

effect_parameters! {
    /// An offset of a force channel that grows with the hours t since it was zeroed, or in proportion to how far the temperature
    /// is from the one at which it is zero. What a sensor comes to that settles: d (1 − e^(−κt))/κ, of which d t is the limit of
    /// κ → 0.
    pub struct ForceDrift {
        /// Drift of the drawbar pull, N/h.
        drawbar_pull_n_per_h: "drawbar_pull_n_per_h" ["N/h"] = 0.0, -200.0 to 200.0, about 0.3;
        /// Drift of the load, N/h.
        load_n_per_h: "load_n_per_h" ["N/h"] = 0.0, -200.0 to 200.0, about 0.3;
        /// Drift of the side force, N/h.
        side_force_n_per_h: "side_force_n_per_h" ["N/h"] = 0.0, -200.0 to 200.0, about 0.3;
        /// κ, 1/h.
        settling_per_h: "settling_per_h" ["1/h"] = 0.0, 0.0 to 20.0, shape 0.7;
        /// Drift of the drawbar pull, N/K.
        drawbar_pull_n_per_c: "drawbar_pull_n_per_c" ["N/K"] = 0.0, -200.0 to 200.0, about 0.2;
        /// Drift of the load, N/K.
        load_n_per_c: "load_n_per_c" ["N/K"] = 0.0, -200.0 to 200.0, about 0.2;
        /// Drift of the side force, N/K.
        side_force_n_per_c: "side_force_n_per_c" ["N/K"] = 0.0, -200.0 to 200.0, about 0.2;
        /// Temperature of no offset, °C.
        reference_c: "reference_c" ["C"] = 20.0, -150.0 to 150.0, about 20.0;
    }
}

impl<S: Scalar> Effect<S> for ForceDrift<S> {
    const ID: &'static str = "force-drift";
    const SUMMARY: &'static str = "the offset of a force channel changes with time or temperature";
    const TEST: &'static str = "the force sensors with the wheel in the air, at the beginning and the end";
    const FORMS: &'static [Form] = &[
        Form {
            name: "drawbar pull with hours",
            free: &["drawbar_pull_n_per_h"],
            set: &[],
            needs: &[Column::DrawbarPull, Column::HoursSinceZero],
        },
        Form {
            name: "load with hours",
            free: &["load_n_per_h"],
            set: &[],
            needs: &[Column::Load, Column::HoursSinceZero],
        },
        Form {
            name: "side force with hours",
            free: &["side_force_n_per_h"],
            set: &[],
            needs: &[Column::SideForce, Column::HoursSinceZero],
        },
        Form {
            name: "drawbar pull, settling",
            free: &["drawbar_pull_n_per_h", "settling_per_h"],
            set: &[],
            needs: &[Column::DrawbarPull, Column::HoursSinceZero],
        },
        Form {
            name: "load, settling",
            free: &["load_n_per_h", "settling_per_h"],
            set: &[],
            needs: &[Column::Load, Column::HoursSinceZero],
        },
        Form {
            name: "side force, settling",
            free: &["side_force_n_per_h", "settling_per_h"],
            set: &[],
            needs: &[Column::SideForce, Column::HoursSinceZero],
        },
        Form {
            name: "drawbar pull with temperature",
            free: &["drawbar_pull_n_per_c"],
            set: &[],
            needs: &[Column::DrawbarPull, Column::Temperature],
        },
        Form {
            name: "load with temperature",
            free: &["load_n_per_c"],
            set: &[],
            needs: &[Column::Load, Column::Temperature],
        },
        Form {
            name: "side force with temperature",
            free: &["side_force_n_per_c"],
            set: &[],
            needs: &[Column::SideForce, Column::Temperature],
        },
        Form {
            name: "drawbar pull with temperature, zero free",
            free: &["drawbar_pull_n_per_c", "reference_c"],
            set: &[],
            needs: &[Column::DrawbarPull, Column::Temperature],
        },
        Form {
            name: "load with temperature, zero free",
            free: &["load_n_per_c", "reference_c"],
            set: &[],
            needs: &[Column::Load, Column::Temperature],
        },
        Form {
            name: "side force with temperature, zero free",
            free: &["side_force_n_per_c", "reference_c"],
            set: &[],
            needs: &[Column::SideForce, Column::Temperature],
        },
    ];
    const ANY_SIZE: bool = true;

    fn read(&self, readings: &mut Readings<S>, _truth: &WheelTruth<S>, at: &Circumstances<'_, S>, _: &mut Memory<S>) {
        if let Some(hours) = at.conditions.hours_since_zero.map(|hours| saturated(hours, self.settling_per_h)) {
            readings.drawbar_pull_n += self.drawbar_pull_n_per_h * hours;
            readings.load_n += self.load_n_per_h * hours;
            readings.side_force_n += self.side_force_n_per_h * hours;
        }
        if let Some(temperature_c) = at.conditions.temperature_c {
            let warmer = temperature_c - self.reference_c;
            readings.drawbar_pull_n += self.drawbar_pull_n_per_c * warmer;
            readings.load_n += self.load_n_per_c * warmer;
            readings.side_force_n += self.side_force_n_per_c * warmer;
        }
    }
}
