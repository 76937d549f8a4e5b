//! Soil whose stiffness or exponent depends on the load.

use crate::scalar::Scalar;
use crate::terramechanics::Soil;

use super::info::effect_parameters;
use super::{Circumstances, Effect, Form, Words};

effect_parameters! {
    /// Under another load than W₀ the stiffness is k (W/W₀)^λ, or the exponent n + μ ln(W/W₀) (a power and a logarithm of
    /// the load, after the load corrections of Ding et al. 2015, J. Field Robotics 32:827–852).
    pub struct LoadStiffening {
        /// λ.
        stiffness_exponent: "stiffness" ["-"] = 0.0, -2.0 to 3.0, about 0.3;
        /// μ.
        exponent_per_log: "exponent" ["-"] = 0.0, -1.0 to 1.0, about 0.1;
        /// W₀, N: the load at which stiffness and exponent are the soil's own.
        reference_load_n: "reference_load_n" ["N"] = 50.0, 0.1 to 100000.0, about 50.0;
    }
}

impl<S: Scalar> Effect<S> for LoadStiffening<S> {
    const ID: &'static str = "load-stiffening";
    const SUMMARY: &'static str = "the stiffness of the soil depends on the load";
    const WORDS: &'static [Words] = &[
        Words {
            parameter: "stiffness",
            above: "the soil is stiffer under more load",
            below: "the soil is softer under more load",
        },
        Words {
            parameter: "exponent",
            above: "the soil is softer under more load",
            below: "the soil is stiffer under more load",
        },
    ];
    const TEST: &'static str = "runs at another load";
    const FORMS: &'static [Form] = &[
        Form { name: "stiffness", free: &["stiffness"], set: &[], needs: &[super::Column::Load] },
        Form { name: "exponent", free: &["exponent"], set: &[], needs: &[super::Column::Load] },
    ];
    const FOLLOWS_LOAD: bool = true;

    fn soil(&self, soil: &mut Soil<S>, at: &Circumstances<'_, S>) {
        let ratio = (at.load_n / self.reference_load_n).max(S::constant(1e-3)).ln();
        soil.scale_stiffness((self.stiffness_exponent * ratio).exp());
        soil.sinkage_exponent = (soil.sinkage_exponent + self.exponent_per_log * ratio).max(S::zero());
    }
}
