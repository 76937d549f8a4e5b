//! A rim too smooth to hold the soil.

use crate::scalar::Scalar;

use super::info::effect_parameters;
use super::{Cap, Circumstances, Effect, Form, ShearConditions};

effect_parameters! {
    /// The soil slides on the rim where the shear stress would exceed c_a + σ tan δ (δ about half to four fifths of φ for
    /// smooth metal).
    pub struct InterfaceFriction {
        /// δ, rad.
        angle_rad: "delta" ["rad"] = 1.57, 0.03 to 1.2, about 0.35;
        /// c_a, Pa.
        adhesion_pa: "adhesion_pa" ["Pa"] = 0.0, 0.0 to 5000.0, about 100.0;
    }
}

impl<S: Scalar> Effect<S> for InterfaceFriction<S> {
    const ID: &'static str = "interface-friction";
    const SUMMARY: &'static str = "the soil slides on the rim";
    const TEST: &'static str = "the same wheel with sandpaper on its rim";
    const FORMS: &'static [Form] = &[
        Form { name: "friction", free: &["delta"], set: &[], needs: &[] },
        Form { name: "friction and adhesion", free: &["delta", "adhesion_pa"], set: &[], needs: &[] },
    ];

    fn shear(&self, shear: &mut ShearConditions<S>, _at: &Circumstances<'_, S>) {
        // An upright angle of friction holds everything.
        if self.angle_rad < S::constant(1.5) {
            let (sin, cos) = self.angle_rad.sin_cos();
            shear.cap = Some(Cap { adhesion_pa: self.adhesion_pa, tan: sin / cos });
        }
    }
}
