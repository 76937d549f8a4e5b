//! Gravity that leaks into the drawbar pull.

use crate::scalar::Scalar;

use super::info::effect_parameters;
use super::{Circumstances, Column, Effect, Form, Memory, Readings, WheelTruth};

effect_parameters! {
    /// The axis of the drawbar pull is tilted by a constant angle, or by a share of the pitch, or it carries a weight of its own
    /// that pitches with it: DP read = DP + W sin(tilt + share · pitch) + w sin(pitch).
    pub struct PitchMisalignment {
        /// The constant tilt, rad.
        tilt_rad: "tilt_rad" ["rad"] = 0.0, -0.4 to 0.4, about 0.02;
        /// The share of the pitch.
        pitch_share: "pitch_share" ["-"] = 0.0, -2.0 to 2.0, about 0.3;
        /// w, N: what hangs on the sensor and does not load the soil.
        own_weight_n: "own_weight_n" ["N"] = 0.0, -500.0 to 500.0, about 5.0;
    }
}

impl<S: Scalar> Effect<S> for PitchMisalignment<S> {
    const ID: &'static str = "pitch-misalignment";
    const SUMMARY: &'static str = "gravity leaks into the drawbar pull";
    const TEST: &'static str = "the same run in the opposite heading, and at another load";
    const FORMS: &'static [Form] = &[
        Form { name: "constant tilt", free: &["tilt_rad"], set: &[], needs: &[Column::DrawbarPull, Column::Load] },
        Form {
            name: "share of pitch",
            free: &["pitch_share"],
            set: &[],
            needs: &[Column::DrawbarPull, Column::Load, Column::Pitch],
        },
        Form {
            name: "own weight along the pitch",
            free: &["own_weight_n"],
            set: &[],
            needs: &[Column::DrawbarPull, Column::Pitch],
        },
    ];
    const ANY_SIZE: bool = true;

    fn read(&self, readings: &mut Readings<S>, truth: &WheelTruth<S>, at: &Circumstances<'_, S>, _: &mut Memory<S>) {
        let pitch = at.conditions.pitch_rad.unwrap_or(S::zero());
        readings.drawbar_pull_n += truth.load_n * (self.tilt_rad + self.pitch_share * pitch).sin();
        readings.drawbar_pull_n += self.own_weight_n * pitch.sin();
    }
}
