//! The same equations taken up one by one.

use crate::identification::least_squares::{Bounds, Triangle};
use crate::identification::observation::{Weighed, check};
use crate::identification::{Assumed, Identified, Observation, Refusal, StressShape, Told, TriangularStress};
use crate::scalar::Scalar;
use crate::terramechanics::Wheel;

use super::IagnemmaAssumptions;

/// Recursive least squares with forgetting: each new equation makes those before it count for less by a factor.
///
/// It starts from nothing, not from a guess with a large covariance, and keeps the triangular root of the equations and
/// not a covariance: with a factor of one it is [`super::iagnemma()`], and it cannot lose its positive variance to rounding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recursive<S> {
    assumed: IagnemmaAssumptions<S>,
    forgetting: S,
    /// c + κ₁ tan φ = κ₂.
    line: Triangle<S, 2>,
    /// What all equations so far count for.
    weight: S,
    /// How many there were, up to what a method can need.
    count: u8,
}

impl<S: Scalar> Recursive<S> {
    /// Nothing observed yet. `forgetting`, above 0 and at most 1, is what an equation counts for once the next has come:
    /// 1 − 1/N remembers some N of them.
    ///
    /// # Errors
    /// [`Refusal::OutOfRange`] where that or the assumed K is out of range.
    pub fn new(assumed: &IagnemmaAssumptions<S>, forgetting: S) -> Result<Self, Refusal> {
        let modulus_m = assumed.shear_modulus_m.value;
        let cohesion_is_finite = assumed.cohesion_pa.is_none_or(|cohesion_pa| cohesion_pa.value.is_finite());
        let in_range = forgetting > S::zero() && forgetting <= S::one();
        if !(in_range && modulus_m > S::zero() && modulus_m.is_finite() && cohesion_is_finite) {
            return Err(Refusal::OutOfRange);
        }
        Ok(Self { assumed: *assumed, forgetting, line: Triangle::new(), weight: S::zero(), count: 0 })
    }

    /// Takes up an observation. One of a braking wheel is left out, and forgets nothing.
    ///
    /// # Errors
    /// As [`super::iagnemma()`]; nothing has then changed.
    pub fn add(&mut self, wheel: &Wheel<S>, observation: &Observation<S>) -> Result<(), Refusal> {
        check(wheel, core::slice::from_ref(observation), 1, Weighed::Nothing)?;
        if observation.state.slip < S::zero() {
            return Ok(());
        }
        let point = Point::new(wheel, observation, self.assumed.shear_modulus_m.value)?;
        self.line.forget(self.forgetting);
        self.line.add([S::one(), point.normal_pa], point.strength_pa);
        self.weight = self.forgetting * self.weight + S::one();
        self.count = self.count.saturating_add(1);
        Ok(())
    }

    /// What the observations so far say. The standard deviations are somewhat too great where there is forgetting.
    ///
    /// # Errors
    /// [`Refusal::TooFew`], [`Refusal::NotIdentifiable`] and [`Refusal::OutOfRange`], as [`super::iagnemma()`].
    pub fn identified(&self) -> Result<Identified<S>, Refusal> {
        let needed = self.assumed.needed();
        if self.count < needed {
            return Err(Refusal::TooFew { needed });
        }
        let told = match &self.assumed.cohesion_pa {
            Some(cohesion_pa) => self.with_cohesion(cohesion_pa),
            None => self.of_both()?,
        };
        told.in_numbers()
    }

    /// c and φ.
    fn of_both(&self) -> Result<Identified<S>, Refusal> {
        let [cohesion_pa, tan] = self.line.solution().ok_or(Refusal::NotIdentifiable)?;
        let [of_cohesion, of_tan] = self.line.variances().ok_or(Refusal::NotIdentifiable)?;
        let variance = self.variance(self.line.rest);
        let std = |share: S| variance.map(|variance| (variance * share).sqrt());
        Ok(Identified {
            cohesion_pa: Told::cohesion(cohesion_pa, std(of_cohesion)),
            friction_angle_rad: Told::friction(tan, std(of_tan)),
            shear_modulus_m: self.shear_modulus(),
            condition_number: self.line.condition_number(),
        })
    }

    /// φ alone.
    fn with_cohesion(&self, cohesion_pa: &Assumed<S>) -> Identified<S> {
        let held = Bounds { low: cohesion_pa.value, high: cohesion_pa.value };
        let best @ [_, tan] = self.line.solution_within([held, Bounds::none()]);
        let std = self.variance(self.line.cost(best)).map(|variance| variance.sqrt() / self.line.length(1));
        Identified {
            cohesion_pa: Told::assumed(cohesion_pa.value, cohesion_pa.std),
            friction_angle_rad: Told::friction(tan, std),
            shear_modulus_m: self.shear_modulus(),
            condition_number: S::one(),
        }
    }

    fn shear_modulus(&self) -> Told<S> {
        let assumed = &self.assumed.shear_modulus_m;
        Told::assumed(assumed.value, assumed.std)
    }

    /// The variance of a κ₂, from the sum of squared residuals; none without more equations than unknowns.
    fn variance(&self, squares: S) -> Option<S> {
        let spare = self.weight - S::constant(f64::from(self.assumed.needed()));
        (spare > S::zero()).then(|| squares / spare)
    }
}

/// A point of Coulomb's line.
struct Point<S> {
    /// κ₁, the normal stress at the peak, Pa.
    normal_pa: S,
    /// κ₂, the shear strength there, Pa.
    strength_pa: S,
}

impl<S: Scalar> Point<S> {
    fn new(wheel: &Wheel<S>, observation: &Observation<S>, shear_modulus_m: S) -> Result<Self, Refusal> {
        let sinkage_m = observation.sinkage_on(wheel)?;
        let stress = TriangularStress::new(wheel, &observation.state, sinkage_m, &StressShape::symmetric());
        let strength_pa = stress.shear_pa / stress.mobilised(shear_modulus_m);
        let point = Self { normal_pa: stress.normal_pa, strength_pa };
        if !(point.normal_pa.is_finite() && point.strength_pa.is_finite()) {
            return Err(Refusal::OutOfRange);
        }
        if point.normal_pa > S::zero() { Ok(point) } else { Err(Refusal::NegativeStress) }
    }
}
