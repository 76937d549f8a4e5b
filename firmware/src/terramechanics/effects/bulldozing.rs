//! Soil that the wheel pushes ahead of itself.

use crate::scalar::Scalar;

use super::info::effect_parameters;
use super::{Circumstances, Column, Effect, Form, WheelTruth};
use crate::terramechanics::Contact;

effect_parameters! {
    /// Rankine's passive resistance over the sunken front, R = γb(z² − z₀²)N_φ/2 + 2cb(z − z₀)√N_φ where z > z₀, taken off
    /// the drawbar pull; it does not act on the torque. The density of the soil is assumed, so the share takes up its error as
    /// well. A shallow wheel rolls over what a deeper one pushes: z₀, 0 in the plain equation, is where that begins.
    pub struct Bulldozing {
        /// Factor on R; 1 is the equation.
        share: "share" ["-"] = 0.0, 0.0 to 20.0, about 1.0;
        /// z₀ as a share of the wheel's radius.
        onset: "onset" ["-"] = 0.0, 0.0 to 0.5, about 0.1;
    }
}

impl<S: Scalar> Effect<S> for Bulldozing<S> {
    const ID: &'static str = "bulldozing";
    const SUMMARY: &'static str = "the wheel pushes soil ahead of itself";
    const TEST: &'static str = "the drawbar pull of the locked wheel at several sinkages";
    const FORMS: &'static [Form] = &[
        Form { name: "passive pressure", free: &["share"], set: &[], needs: &[Column::DrawbarPull] },
        Form {
            name: "passive pressure beyond an onset",
            free: &["share", "onset"],
            set: &[],
            needs: &[Column::DrawbarPull],
        },
    ];

    fn resist(&self, truth: &mut WheelTruth<S>, _contact: &Contact<S>, at: &Circumstances<'_, S>) {
        let (depth, passive) = (truth.sinkage_m, at.passive_coefficient());
        let onset = self.onset * at.wheel.radius_m;
        let pushed = (depth - onset).max(S::zero());
        let weight = S::constant(0.5) * at.unit_weight_n_m3() * (depth + onset) * passive;
        let cohesion = S::constant(2.0) * at.soil.cohesion_pa * passive.sqrt();
        truth.drawbar_pull_n += -(self.share * pushed * at.wheel.width_m * (weight + cohesion));
    }
}
