//! The probabilities of a bank of soils, moved by one observation after the other.

use heapless::Vec;

use crate::scalar::Scalar;
use crate::terramechanics::{Soil, Wheel};

use super::super::observation::{Weighed, check};
use super::super::{Identified, Observation, Refusal};
use super::likelihood::Likelihood;
use super::posterior::answer;

/// No soil is held to be less likely than this before an update, so that a change of terrain is followed.
const FLOOR: f64 = 1e-3;
/// A soil whose ln probability is less than the best one's by so much counts as none: 64 like it change the mean of a double in its last
/// digits.
const NEGLIGIBLE: f64 = 40.0;

/// A bank of at most `N` soils and how likely each is to be under the wheels.
#[derive(Debug, Clone)]
pub struct MultipleModel<'a, S, const N: usize> {
    bank: &'a [Soil<S>],
    /// Of each soil of the bank in its order; their sum is 1.
    probabilities: Vec<S, N>,
}

impl<'a, S: Scalar, const N: usize> MultipleModel<'a, S, N> {
    /// Every soil of the bank is as likely as any other.
    ///
    /// # Errors
    /// [`Refusal::NoSoilFits`] where the bank is empty, [`Refusal::TooMany`] where it has more than `N` soils.
    pub fn new(bank: &'a [Soil<S>]) -> Result<Self, Refusal> {
        if bank.is_empty() {
            return Err(Refusal::NoSoilFits);
        }
        let share = S::one() / S::constant(bank.len() as f64);
        let probabilities = bank.iter().map(|_| share);
        let mut model = Self { bank, probabilities: Vec::new() };
        for probability in probabilities {
            let room = N.min(usize::from(u8::MAX)) as u8;
            model.probabilities.push(probability).map_err(|_| Refusal::TooMany { room })?;
        }
        Ok(model)
    }

    /// How likely each soil is, in the bank's order.
    pub fn probabilities(&self) -> &[S] {
        &self.probabilities
    }

    /// Takes in the wheels of an instant, or any observations that surely are of one soil, and says what the soil is.
    ///
    /// Before that, no soil is held to be less likely than 1e-3. A soil that does not carry every wheel, or is less likely than the
    /// best by 1e-17, has no probability left after it. Driving and braking are alike to the method; it does not look at sinkage.
    ///
    /// Mean and standard deviation are those of the bank's soils under their probabilities; the condition number is how many
    /// soils they are spread over, e to the power of their entropy: 1 where one soil is left, the size of the bank where
    /// the observations say nothing. Nothing is identifiable where even the best soil leaves a χ² that one right soil in
    /// thirty thousand would: the soil is not in the bank, and the mean says of it what the nearest one has.
    ///
    /// Cost for each soil and observation: [`crate::terramechanics::sinkage_for_load`], and the forces with two
    /// derivatives.
    ///
    /// # Errors
    /// [`Refusal::NoSoilFits`] where no soil of the bank carries every wheel, [`Refusal::TooFew`] without observations,
    /// [`Refusal::NotFinite`] and [`Refusal::OutOfRange`]. The probabilities then stay as they were.
    pub fn update(&mut self, wheel: &Wheel<S>, observations: &[Observation<S>]) -> Result<Identified<S>, Refusal> {
        check(wheel, observations, 1, Weighed::AllButSinkage)?;
        let mut logarithms = Vec::<Option<S>, N>::new();
        let (mut best, mut least_chi_square) = (None::<S>, None::<S>);
        for (soil, probability) in self.bank.iter().zip(&self.probabilities) {
            let before = probability.max(S::constant(FLOOR)).ln();
            let hopeless = best.map(|best| best - S::constant(NEGLIGIBLE) - before);
            let likelihood = Likelihood::of(soil, wheel, observations, hopeless);
            let ln = likelihood.map(|likelihood| likelihood.ln + before);
            if let (Some(likelihood), Some(ln)) = (likelihood, ln) {
                best = Some(best.map_or(ln, |best| best.max(ln)));
                let least = least_chi_square.map_or(likelihood.chi_square, |least: S| least.min(likelihood.chi_square));
                least_chi_square = Some(least);
            }
            // Both lists are as long as the bank.
            let _ = logarithms.push(ln);
        }
        let (Some(best), Some(least_chi_square)) = (best, least_chi_square) else {
            return Err(Refusal::NoSoilFits);
        };
        // Over the best one, so that the sum is at least 1 whatever the others lose.
        let over_best = |ln: &Option<S>| ln.map_or(S::zero(), |ln| (ln - best).exp());
        let sum = logarithms.iter().map(over_best).fold(S::zero(), |sum, share| sum + share);
        for (probability, ln) in self.probabilities.iter_mut().zip(&logarithms) {
            *probability = over_best(ln) / sum;
        }
        let explained = least_chi_square <= greatest_chi_square(observations.len());
        Ok(answer(self.bank, &self.probabilities, explained))
    }
}

/// What χ² of two channels an observation exceeds with a probability of 3e-5 (four standard deviations), by Wilson and
/// Hilferty's cube.
fn greatest_chi_square<S: Scalar>(observations: usize) -> S {
    let freedom = S::constant(2.0 * observations as f64);
    let spread = S::constant(2.0) / (S::constant(9.0) * freedom);
    let root = S::one() - spread + S::constant(4.0) * spread.sqrt();
    freedom * root * root * root
}
