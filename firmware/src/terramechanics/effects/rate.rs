//! Soil that answers to speed.

use crate::scalar::Scalar;
use crate::terramechanics::{Contact, Soil};

use super::info::effect_parameters;
use super::{Circumstances, Column, Effect, Form, WheelTruth, Words};

effect_parameters! {
    /// Stiffness and strength are powers of the speed: k (v/v₀)^m (after Bekker's plate tests at several rates), and
    /// (c, tan φ)(v/v₀)^q. Soil that is thrown out of the way takes the momentum ρ b z v² off the drawbar pull in every second;
    /// its density is assumed, so the share takes up that error as well.
    pub struct Rate {
        /// m.
        stiffness_exponent: "stiffness" ["-"] = 0.0, -1.5 to 1.5, about 0.2;
        /// q.
        strength_exponent: "strength" ["-"] = 0.0, -1.0 to 1.0, about 0.1;
        /// Factor on ρ b z v²; 1 is the equation.
        excavation_share: "excavation" ["-"] = 0.0, 0.0 to 200.0, about 1.0;
        /// v₀, m/s: the speed at which stiffness and strength are the soil's own.
        reference_speed_m_s: "reference_speed_m_s" ["m/s"] = 0.02, 0.000001 to 100.0, about 0.02;
    }
}

impl<S: Scalar> Effect<S> for Rate<S> {
    const ID: &'static str = "rate";
    const SUMMARY: &'static str = "the soil answers to speed";
    const WORDS: &'static [Words] = &[
        Words { parameter: "stiffness", above: "the soil is stiffer at speed", below: "the soil is softer at speed" },
        Words { parameter: "strength", above: "the soil is stronger at speed", below: "the soil is weaker at speed" },
        Words {
            parameter: "excavation",
            above: "soil that is thrown aside takes pull off the wheel, the more the faster it is",
            below: "soil that is thrown aside takes pull off the wheel, the more the faster it is",
        },
    ];
    const TEST: &'static str = "the same slip at another speed";
    const FORMS: &'static [Form] = &[
        Form { name: "stiffness", free: &["stiffness"], set: &[], needs: &[Column::Speed] },
        Form { name: "strength", free: &["strength"], set: &[], needs: &[Column::Speed] },
        Form { name: "stiffness and strength", free: &["stiffness", "strength"], set: &[], needs: &[Column::Speed] },
        Form { name: "excavation", free: &["excavation"], set: &[], needs: &[Column::DrawbarPull, Column::Speed] },
    ];

    fn soil(&self, soil: &mut Soil<S>, at: &Circumstances<'_, S>) {
        let Some(speed) = at.speed_m_s() else {
            return;
        };
        let ratio = (speed.abs() / self.reference_speed_m_s).max(S::constant(1e-6)).ln();
        soil.scale_stiffness((self.stiffness_exponent * ratio).exp());
        soil.scale_strength((self.strength_exponent * ratio).exp());
    }

    fn resist(&self, truth: &mut WheelTruth<S>, _contact: &Contact<S>, at: &Circumstances<'_, S>) {
        if let Some(speed) = at.speed_m_s() {
            let swept_m2 = at.wheel.width_m * truth.sinkage_m;
            truth.drawbar_pull_n += -(self.excavation_share * at.density_kg_m3() * swept_m2 * speed * speed.abs());
        }
    }
}
