//! The drawbar pulls of a soil, and how they go with φ, K and k.

use crate::dual::Dual;
use crate::scalar::Scalar;
use crate::terramechanics::{Quadrature, Soil, Wheel, wheel_forces_by};

use super::super::{Observation, Refusal};
use super::{Equations, Unknowns};

/// The driven observations of a wheel, and what is assumed of the soil under it.
pub(super) struct DrawbarPulls<'a, S> {
    wheel: &'a Wheel<S>,
    observations: &'a [Observation<S>],
    assumed: &'a Soil<S>,
}

impl<'a, S: Scalar> DrawbarPulls<'a, S> {
    /// Those of checked observations.
    pub fn new(wheel: &'a Wheel<S>, observations: &'a [Observation<S>], assumed: &'a Soil<S>) -> Result<Self, Refusal> {
        let pulls = Self { wheel, observations, assumed };
        if pulls.driven().any(|observation| observation.state.sinkage_m.is_none()) {
            return Err(Refusal::NoSinkage);
        }
        let reaches = |sinkage_m: S| sinkage_m > S::zero() && sinkage_m <= wheel.radius_m;
        let in_range = pulls.driven().all(|observation| observation.state.sinkage_m.is_some_and(reaches));
        let start_rises = pulls.start().iter().all(|ln| ln.is_finite());
        if in_range && start_rises && assumed.is_valid() { Ok(pulls) } else { Err(Refusal::OutOfRange) }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.driven().count()
    }

    /// ln φ, ln K and ln k of the assumed soil.
    pub fn start(&self) -> Unknowns<S> {
        let stiffness = self.assumed.stiffness(self.wheel.width_m);
        [self.assumed.friction_angle_rad, self.assumed.shear_modulus_m, stiffness].map(Scalar::ln)
    }

    /// The equations DP measured = DP of the soil with the logarithms `at`, straightened there and over the noise; none
    /// where the soil gives no drawbar pull.
    pub fn equations(&self, at: &Unknowns<S>) -> Option<Equations<S>> {
        let soil = self.soil(at);
        let wheel = self.wheel.map(Dual::fixed);
        let mut equations = Equations::new();
        for observation in self.driven() {
            let [slip, sinkage_m] = [observation.state.slip, observation.state.sinkage_m?].map(Dual::fixed);
            let forces = wheel_forces_by(&Quadrature::SIMPSON, &wheel, &soil, slip, sinkage_m).ok()?;
            let (pull, std) = (forces.drawbar_pull_n, observation.noise.drawbar_pull_n);
            let missing = (observation.state.drawbar_pull_n - pull.value) / std;
            equations.add(pull.slopes.map(|slope| slope / std), missing);
        }
        equations.cost_at_zero().is_finite().then_some(equations)
    }

    fn driven(&self) -> impl Iterator<Item = &Observation<S>> {
        self.observations.iter().filter(|observation| observation.is_driven())
    }

    fn soil(&self, at: &Unknowns<S>) -> Soil<Dual<S, 3>> {
        let [ln_angle, ln_modulus, ln_stiffness] = *at;
        let unknown = |ln: S, place| Dual::variable(ln, place).exp();
        Soil {
            friction_angle_rad: unknown(ln_angle, 0),
            shear_modulus_m: unknown(ln_modulus, 1),
            frictional_modulus: unknown(ln_stiffness, 2),
            cohesive_modulus: Dual::zero(),
            ..self.assumed.map(Dual::fixed)
        }
    }
}
