//! Mean and spread of a bank's soils under their probabilities.

use crate::scalar::Scalar;
use crate::terramechanics::Soil;

use super::super::{Belief, Identified, SoilPrior, Told};

/// Mean and standard deviation.
#[derive(Clone, Copy)]
struct Moments<S> {
    mean: S,
    std: S,
}

/// What a bank with probabilities that add up to 1 says of the soil. `explained`: the best of it is not at odds with what
/// was seen.
pub(super) fn answer<S: Scalar>(bank: &[Soil<S>], probabilities: &[S], explained: bool) -> Identified<S> {
    let prior = SoilPrior::usual();
    let moments = |of: &dyn Fn(&Soil<S>) -> S| moments(bank, probabilities, of);
    let told = |of: fn(&Soil<S>) -> S, believed: &dyn Fn(&Soil<S>) -> S, belief: &Belief<S>| {
        let in_its_unit = moments(&|soil| of(soil));
        let ratio = moments(believed).std / belief.std.unwrap_or(S::one());
        let told = Told::estimated(in_its_unit.mean, Some(in_its_unit.std), ratio);
        Told { identifiable: told.identifiable && explained, ..told }
    };
    // A soil without cohesion has no logarithm of it.
    let logarithm = |value: S, belief: &Belief<S>| value.max(belief.low.exp()).ln();
    let ln_cohesion = |soil: &Soil<S>| logarithm(soil.cohesion_pa, &prior.ln_cohesion);
    let ln_modulus = |soil: &Soil<S>| logarithm(soil.shear_modulus_m, &prior.ln_shear_modulus);
    Identified {
        cohesion_pa: told(|soil| soil.cohesion_pa, &ln_cohesion, &prior.ln_cohesion),
        friction_angle_rad: told(
            |soil| soil.friction_angle_rad,
            &|soil| soil.friction_angle_rad,
            &prior.friction_angle_rad,
        ),
        shear_modulus_m: told(|soil| soil.shear_modulus_m, &ln_modulus, &prior.ln_shear_modulus),
        condition_number: spread_over(probabilities),
    }
}

fn moments<S: Scalar>(bank: &[Soil<S>], probabilities: &[S], of: &dyn Fn(&Soil<S>) -> S) -> Moments<S> {
    let weighted = |of: &dyn Fn(&Soil<S>) -> S| {
        bank.iter().zip(probabilities).fold(S::zero(), |sum, (soil, &probability)| sum + probability * of(soil))
    };
    let mean = weighted(of);
    let variance = weighted(&|soil| (of(soil) - mean) * (of(soil) - mean));
    Moments { mean, std: variance.sqrt() }
}

/// How many soils the probabilities are spread over: e to the power of their entropy.
fn spread_over<S: Scalar>(probabilities: &[S]) -> S {
    let surprise = |probability: S| {
        if probability > S::zero() { -(probability * probability.ln()) } else { S::zero() }
    };
    probabilities.iter().fold(S::zero(), |sum, &probability| sum + surprise(probability)).exp()
}
