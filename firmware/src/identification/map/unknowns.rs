//! The unknowns that all observations share, and what is believed of them.

use crate::identification::{Belief, Refusal, SoilPrior};
use crate::scalar::Scalar;
use crate::terramechanics::Soil;

use super::FreeParameter;

/// Parameters of effects that may be fitted along.
pub const EFFECT_PARAMETERS: usize = 4;
/// Unknowns: those of the effects, then those of the soil.
pub(super) const UNKNOWNS: usize = EFFECT_PARAMETERS + 7;

/// Places of the soil's unknowns. What is asked comes last, so that its information is the lower end of the triangle; the
/// cohesion at the very end, so that the others can be found for a cohesion that is held.
pub(super) const EXPONENT: usize = EFFECT_PARAMETERS;
pub(super) const STIFFNESS: usize = EFFECT_PARAMETERS + 1;
pub(super) const C1: usize = EFFECT_PARAMETERS + 2;
pub(super) const C2: usize = EFFECT_PARAMETERS + 3;
pub(super) const MODULUS: usize = EFFECT_PARAMETERS + 4;
pub(super) const FRICTION: usize = EFFECT_PARAMETERS + 5;
pub(super) const COHESION: usize = EFFECT_PARAMETERS + 6;

/// A point. A coordinate of a normal belief is the distance from its mean in standard deviations; one of a flat belief is
/// the normal quantile of the share of its range. So every belief is a standard normal distribution, and a range has
/// no ends that a descent could stick to.
pub(super) type Point<S> = [S; UNKNOWNS];

/// What is believed of the unknowns.
#[derive(Debug, Clone)]
pub(super) struct Unknowns<S> {
    /// By place; those that no effect needs are known.
    pub beliefs: [Belief<S>; UNKNOWNS],
    /// Parameters of effects among them.
    pub effects: usize,
    known_depth_m: S,
    rebound_ratio: S,
}

impl<S: Scalar> Unknowns<S> {
    /// Of a soil and of the parameters of effects that are fitted.
    ///
    /// # Errors
    /// Where a belief contradicts itself.
    pub fn new(prior: &SoilPrior<S>, effects: &[FreeParameter<S>]) -> Result<Self, Refusal> {
        let mut beliefs = [Belief::known(S::zero()); UNKNOWNS];
        let of_soil = [
            prior.sinkage_exponent,
            prior.ln_stiffness,
            prior.peak_stress_c1,
            prior.peak_stress_c2,
            prior.ln_shear_modulus,
            prior.friction_angle_rad,
            prior.ln_cohesion,
        ];
        let of_effects = effects.iter().map(|parameter| parameter.belief);
        let padding = core::iter::repeat(Belief::known(S::zero()));
        let all = of_effects.chain(padding).take(EFFECT_PARAMETERS).chain(of_soil);
        for (slot, belief) in beliefs.iter_mut().zip(all) {
            *slot = belief;
        }
        let unknowns = Self {
            beliefs,
            effects: effects.len(),
            known_depth_m: prior.known_depth_m,
            rebound_ratio: prior.rebound_ratio.mean,
        };
        let valid = beliefs.iter().all(Belief::is_valid) && prior.known_depth_m > S::zero();
        if valid { Ok(unknowns) } else { Err(Refusal::OutOfRange) }
    }

    /// The value of an unknown at a coordinate, in the unit of its belief, and its slope.
    fn value_at(&self, place: usize, coordinate: S) -> (S, S) {
        let Some(belief) = self.beliefs.get(place) else { return (S::zero(), S::zero()) };
        if belief.std.is_some() {
            return (belief.mean + coordinate * belief.spread(), belief.spread());
        }
        let (share, slope) = normal_share(coordinate);
        let range = belief.high - belief.low;
        (belief.low + range * share, range * slope)
    }

    /// The value of an unknown at a point, in the unit of its belief.
    pub fn value(&self, place: usize, point: &Point<S>) -> S {
        self.value_at(place, point.get(place).copied().unwrap_or(S::zero())).0
    }

    /// Change of that value with its coordinate.
    pub fn slope(&self, place: usize, point: &Point<S>) -> S {
        self.value_at(place, point.get(place).copied().unwrap_or(S::zero())).1
    }

    /// Mean and variance of an unknown whose coordinate is normal with the given mean and variance; of a flat belief by five
    /// nodes of Gauss and Hermite.
    pub fn moments(&self, place: usize, mean: S, variance: S) -> (S, S) {
        // Nodes of weight e^(−x²/2) and their weights over √(2π).
        const NODES: [(f64, f64); 5] = [
            (-2.856_970_013_872_806, 0.011_257_411_327_720_69),
            (-1.355_626_179_974_266, 0.222_075_922_005_612_6),
            (0.0, 0.533_333_333_333_333_3),
            (1.355_626_179_974_266, 0.222_075_922_005_612_6),
            (2.856_970_013_872_806, 0.011_257_411_327_720_69),
        ];
        let (middle, slope) = self.value_at(place, mean);
        if self.beliefs.get(place).is_none_or(|belief| belief.std.is_some()) {
            return (middle, slope * slope * variance);
        }
        let std = variance.sqrt();
        let (mut first, mut second) = (S::zero(), S::zero());
        for (node, weight) in NODES {
            let away = self.value_at(place, mean + std * S::constant(node)).0 - middle;
            first += S::constant(weight) * away;
            second += S::constant(weight) * away * away;
        }
        (middle + first, (second - first * first).max(S::zero()))
    }

    /// The values of all unknowns, each in the unit of its belief and as a number of another kind: `lift` gives a value its
    /// place.
    pub fn values<T: Scalar>(&self, point: &Point<S>, lift: impl Fn(usize, S) -> T) -> [T; UNKNOWNS] {
        core::array::from_fn(|place| lift(place, self.value(place, point)))
    }

    /// The soil that values, in the units of the beliefs, describe; all its stiffness is in k_φ.
    pub fn soil<T: Scalar>(&self, values: &[T; UNKNOWNS], lift: impl Fn(S) -> T) -> Soil<T> {
        let [.., exponent, ln_stiffness, c1, c2, ln_modulus, friction_angle_rad, ln_cohesion] = *values;
        let away = exponent - lift(self.beliefs.get(EXPONENT).map_or(S::zero(), |belief| belief.mean));
        Soil {
            sinkage_exponent: exponent,
            cohesive_modulus: lift(S::zero()),
            frictional_modulus: (ln_stiffness - away * lift(self.known_depth_m.ln())).exp(),
            cohesion_pa: ln_cohesion.exp(),
            friction_angle_rad,
            shear_modulus_m: ln_modulus.exp(),
            peak_stress_c1: c1,
            peak_stress_c2: c2,
            rebound_ratio: lift(self.rebound_ratio),
        }
    }

    /// The soil at a point.
    pub fn soil_at(&self, point: &Point<S>) -> Soil<S> {
        self.soil(&self.values(point, |_, value| value), |value| value)
    }

    /// Bounds of an unknown as coordinates of a point; both zero where it is known. Of a flat belief all but a
    /// thousandth of its range at either end.
    pub fn bounds(&self, place: usize) -> (S, S) {
        let Some(belief) = self.beliefs.get(place).filter(|belief| !belief.is_known()) else {
            return (S::zero(), S::zero());
        };
        if belief.std.is_none() {
            return (S::constant(-3.0), S::constant(3.0));
        }
        let scaled = |bound: S| (bound - belief.mean) / belief.spread();
        (scaled(belief.low), scaled(belief.high))
    }

    /// A point moved into the bounds.
    pub fn inside(&self, point: &Point<S>) -> Point<S> {
        let mut inside = *point;
        for (place, slot) in inside.iter_mut().enumerate() {
            let (low, high) = self.bounds(place);
            *slot = slot.max(low).min(high);
        }
        inside
    }

    /// Whether an unknown is known.
    pub fn is_known(&self, place: usize) -> bool {
        self.beliefs.get(place).is_none_or(Belief::is_known)
    }
}

/// The distribution function of the standard normal and its slope, by a logistic function whose error is below 1.5e-4:
/// S. R. Bowling, M. T. Khasawneh, S. Kaewkuekool, B. R. Cho, J. Ind. Eng. Manage. 2 (2009) 114–127. Only what is called
/// flat depends on it: flat to some parts in ten thousand.
fn normal_share<S: Scalar>(coordinate: S) -> (S, S) {
    let (linear, cubic) = (S::constant(1.5976), S::constant(0.070_56));
    let square = coordinate * coordinate;
    let share = S::one() / (S::one() + (-(coordinate * (linear + cubic * square))).exp());
    (share, share * (S::one() - share) * (linear + S::constant(3.0) * cubic * square))
}
