//! Soil that earlier passes have compacted.

use crate::scalar::Scalar;
use crate::terramechanics::Soil;

use super::info::effect_parameters;
use super::{Circumstances, Column, Effect, Form, Words};

effect_parameters! {
    /// Stiffness of the j-th pass: k⁽ʲ⁾ = k [1 + m₁ (1 − e^(−m₂ (j − 1)))] (form after Senatore and Sandu 2014, who let cohesion
    /// and friction grow, too): (c, tan φ)⁽ʲ⁾ = (c, tan φ)[1 + q (1 − e^(−m₂ (j − 1)))].
    pub struct MultiPass {
        /// m₁.
        stiffening: "m1" ["-"] = 0.0, -0.9 to 8.0, about 0.5;
        /// q.
        strengthening: "strength" ["-"] = 0.0, -0.9 to 3.0, about 0.2;
        /// m₂.
        rate: "m2" ["-"] = 1.0, 0.05 to 5.0, shape 1.0;
    }
}

impl<S: Scalar> Effect<S> for MultiPass<S> {
    const ID: &'static str = "multi-pass";
    const SUMMARY: &'static str = "the soil differs where a wheel has been";
    const WORDS: &'static [Words] = &[
        Words {
            parameter: "m1",
            above: "the soil is stiffer where a wheel has been",
            below: "the soil is softer where a wheel has been",
        },
        Words {
            parameter: "strength",
            above: "the soil is stronger where a wheel has been",
            below: "the soil is weaker where a wheel has been",
        },
    ];
    const TEST: &'static str = "a run beside the rut";
    const FORMS: &'static [Form] = &[
        Form { name: "stiffness", free: &["m1"], set: &[], needs: &[Column::Pass] },
        Form { name: "stiffness, rate free", free: &["m1", "m2"], set: &[], needs: &[Column::Pass] },
        Form { name: "strength", free: &["strength"], set: &[], needs: &[Column::Pass] },
        Form { name: "stiffness and strength", free: &["m1", "strength"], set: &[], needs: &[Column::Pass] },
        Form {
            name: "stiffness and strength, rate free",
            free: &["m1", "strength", "m2"],
            set: &[],
            needs: &[Column::Pass],
        },
    ];

    fn soil(&self, soil: &mut Soil<S>, at: &Circumstances<'_, S>) {
        if let Some(pass) = at.conditions.pass {
            let before = (pass - S::one()).max(S::zero());
            let share = S::one() - (-(self.rate * before)).exp();
            let grown = |by: S| (S::one() + by * share).max(S::constant(0.02));
            soil.scale_stiffness(grown(self.stiffening));
            soil.scale_strength(grown(self.strengthening));
        }
    }
}
