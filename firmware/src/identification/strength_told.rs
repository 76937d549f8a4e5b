//! Cohesion, friction and shear modulus as told by a fit in c, tan φ and ln K.

use crate::scalar::Scalar;
use crate::terramechanics::angle_of_tangent;

use super::{SoilPrior, Told};

impl<S: Scalar> Told<S> {
    /// c (Pa) of the given standard deviation. One that is not above zero is none that a soil can have: not identifiable.
    pub(super) fn cohesion(cohesion_pa: S, std: Option<S>) -> Self {
        let believed = SoilPrior::<S>::usual().ln_cohesion.std.map(|std| std * cohesion_pa);
        Self::against(cohesion_pa, std, believed).only_if(cohesion_pa > S::zero())
    }

    /// φ, from tan φ of the given standard deviation. Identifiable only above zero.
    pub(super) fn friction(tan_friction: S, std: Option<S>) -> Self {
        // dφ/d tan φ = cos² φ.
        let std = std.map(|std| std / (S::one() + tan_friction * tan_friction));
        let believed = SoilPrior::usual().friction_angle_rad.std;
        Self::against(angle_of_tangent(tan_friction), std, believed).only_if(tan_friction > S::zero())
    }

    /// K (m), of which ln K has the given standard deviation.
    pub(super) fn shear_modulus(shear_modulus_m: S, std_of_ln: Option<S>) -> Self {
        let believed = SoilPrior::<S>::usual().ln_shear_modulus.std.map(|std| std * shear_modulus_m);
        Self::against(shear_modulus_m, std_of_ln.map(|std| std * shear_modulus_m), believed)
    }

    /// The same, identifiable only on a further condition.
    pub(super) fn only_if(self, condition: bool) -> Self {
        Self { identifiable: self.identifiable && condition, ..self }
    }

    /// A value whose standard deviation is set against what is believed beforehand; not identifiable without one.
    fn against(value: S, std: Option<S>, believed: Option<S>) -> Self {
        let ratio = std.zip(believed).map_or(S::constant(f64::INFINITY), |(std, believed)| std / believed);
        Self::estimated(value, std, ratio)
    }
}
