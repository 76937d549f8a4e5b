//! The line at the grouser count per turn of the wheel.

use crate::scalar::Scalar;
use crate::terramechanics::Soil;

use super::info::effect_parameters;
use super::{Circumstances, Column, Effect, Form, Memory, Readings, WheelTruth};

effect_parameters! {
    /// Stresses or channels swing with the angle of the wheel times the count of its grousers (Irani, Bauer and Warkentin
    /// 2011, J. Terramechanics 48: stress = mean + A sin(N_g θ_w + φ)); each amplitude as its sine and its cosine part.
    ///
    /// - `stress`: share by which pressure and shear strength swing together;
    /// - one channel's own swing, in its unit.
    pub struct GrouserRipple {
        /// Sine part of the stresses.
        stress_sin: "stress_sin" ["-"] = 0.0, -0.9 to 0.9, about 0.05;
        /// Cosine part of the stresses.
        stress_cos: "stress_cos" ["-"] = 0.0, -0.9 to 0.9, about 0.05;
        /// Sine part of the drawbar pull, N.
        drawbar_pull_sin_n: "drawbar_pull_sin_n" ["N"] = 0.0, -300.0 to 300.0, about 1.0;
        /// Cosine part of the drawbar pull, N.
        drawbar_pull_cos_n: "drawbar_pull_cos_n" ["N"] = 0.0, -300.0 to 300.0, about 1.0;
        /// Sine part of the torque, N·m.
        torque_sin_nm: "torque_sin_nm" ["N m"] = 0.0, -100.0 to 100.0, about 0.1;
        /// Cosine part of the torque, N·m.
        torque_cos_nm: "torque_cos_nm" ["N m"] = 0.0, -100.0 to 100.0, about 0.1;
        /// Sine part of the sinkage, m.
        sinkage_sin_m: "sinkage_sin_m" ["m"] = 0.0, -0.05 to 0.05, about 0.001;
        /// Cosine part of the sinkage, m.
        sinkage_cos_m: "sinkage_cos_m" ["m"] = 0.0, -0.05 to 0.05, about 0.001;
    }
}

impl<S: Scalar> Effect<S> for GrouserRipple<S> {
    const ID: &'static str = "grouser-ripple";
    const SUMMARY: &'static str = "forces swing as each grouser passes";
    const TEST: &'static str = "one turn of the wheel sampled finely, at another wheel speed as well";
    const FORMS: &'static [Form] = &[
        Form {
            name: "stress",
            free: &["stress_sin", "stress_cos"],
            set: &[],
            needs: &[Column::Grousers, Column::WheelAngle],
        },
        Form {
            name: "drawbar pull",
            free: &["drawbar_pull_sin_n", "drawbar_pull_cos_n"],
            set: &[],
            needs: &[Column::Grousers, Column::WheelAngle, Column::DrawbarPull],
        },
        Form {
            name: "torque",
            free: &["torque_sin_nm", "torque_cos_nm"],
            set: &[],
            needs: &[Column::Grousers, Column::WheelAngle, Column::Torque],
        },
        Form {
            name: "sinkage",
            free: &["sinkage_sin_m", "sinkage_cos_m"],
            set: &[],
            needs: &[Column::Grousers, Column::WheelAngle, Column::Sinkage],
        },
        Form {
            name: "drawbar pull and torque",
            free: &["drawbar_pull_sin_n", "drawbar_pull_cos_n", "torque_sin_nm", "torque_cos_nm"],
            set: &[],
            needs: &[Column::Grousers, Column::WheelAngle, Column::DrawbarPull, Column::Torque],
        },
    ];

    fn soil(&self, soil: &mut Soil<S>, at: &Circumstances<'_, S>) {
        if let Some((sin, cos)) = at.grouser_phase() {
            let swing = (S::one() + self.stress_sin * sin + self.stress_cos * cos).max(S::constant(0.05));
            soil.scale_stiffness(swing);
            soil.cohesion_pa = soil.cohesion_pa * swing;
        }
    }

    fn read(&self, readings: &mut Readings<S>, _truth: &WheelTruth<S>, at: &Circumstances<'_, S>, _: &mut Memory<S>) {
        if let Some((sin, cos)) = at.grouser_phase() {
            readings.drawbar_pull_n += self.drawbar_pull_sin_n * sin + self.drawbar_pull_cos_n * cos;
            readings.torque_nm += self.torque_sin_nm * sin + self.torque_cos_nm * cos;
            readings.sinkage_m += self.sinkage_sin_m * sin + self.sinkage_cos_m * cos;
        }
    }
}
