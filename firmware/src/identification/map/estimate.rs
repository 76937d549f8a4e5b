//! The method from its inputs to its answer.

use heapless::Vec;

use crate::identification::observation::{Weighed, check};
use crate::identification::{Identified, Observation, Refusal, SoilPrior, Told};
use crate::scalar::Scalar;
use crate::terramechanics::effects::Conditions;
use crate::terramechanics::{Soil, Wheel};

use super::by_seed::BySeed;
use super::condition::condition_number;
use super::descent::Descent;
use super::mixture::{Moments, moments};
use super::mode::{best_mode, is_beyond_chance, mode_nearby};
use super::prediction::{Forward, Model};
use super::problem::{Fit, Problem};
use super::unknowns::{C1, C2, COHESION, EFFECT_PARAMETERS, EXPONENT, FRICTION, MODULUS, STIFFNESS, Unknowns};
use super::{CAPACITY, DeclaredEffects};

/// Posterior mean and standard deviation of a number, in the unit of its belief.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fitted<S> {
    /// Mean.
    pub mean: S,
    /// One standard deviation; zero of a number that is held to be known.
    pub std: S,
}

/// What the method says.
#[derive(Debug, Clone, PartialEq)]
pub struct MapEstimate<S> {
    /// Cohesion, friction angle and shear modulus. The cohesion and the modulus are e to the posterior mean of the
    /// logarithm, and their standard deviations those of a log-normal distribution, as the networks have them.
    pub identified: Identified<S>,
    /// ln c, c in Pa.
    pub ln_cohesion: Fitted<S>,
    /// φ, rad.
    pub friction_angle_rad: Fitted<S>,
    /// ln K, K in m.
    pub ln_shear_modulus: Fitted<S>,
    /// n.
    pub sinkage_exponent: Fitted<S>,
    /// The logarithm of the stiffness as [`SoilPrior::ln_stiffness`] has it: at the prior's mean exponent.
    pub ln_stiffness: Fitted<S>,
    /// c₁.
    pub peak_stress_c1: Fitted<S>,
    /// c₂.
    pub peak_stress_c2: Fitted<S>,
    /// The parameters of effects, in the order in which they were declared.
    pub effects: Vec<Fitted<S>, EFFECT_PARAMETERS>,
    /// The soil with the means; its stiffness is all in k_φ.
    pub soil: Soil<S>,
    /// The soil at the mode.
    pub mode: Soil<S>,
    /// Sum of the squared residuals of the observations at the mode, each over its standard deviation.
    pub chi_squared: S,
    /// How many residuals that is.
    pub residuals: u16,
    /// The same sum with the residuals of the beliefs: where model, noise and beliefs hold, it is distributed as χ² with
    /// [`MapEstimate::degrees_of_freedom`]. Far more says that the model does not explain the observations.
    pub misfit: S,
    /// Residuals of observations and beliefs less unknowns.
    pub degrees_of_freedom: u16,
    /// By how much the noise is taken greater than it is stated for means and standard deviations: 1, or where the misfit is
    /// beyond chance its root per degree of freedom (R. T. Birge, Phys. Rev. 40 (1932) 207–227). A model that does not explain
    /// the observations must not seem sure of the soil; how wrong it is, nobody knows.
    pub widened: S,
    /// Steps of all descents; each evaluates every wheel once.
    pub iterations: u16,
    /// Whether the descent to the mode settled.
    pub settled: bool,
}

/// The soil under wheels that the seed's equations 1–11 describe.
///
/// # Errors
/// Where there is no observation, or more than [`CAPACITY`], where a number is out of its range, or where nowhere in the
/// prior the equations hold.
pub fn identify<S: Scalar>(
    wheel: &Wheel<S>,
    observations: &[Observation<S>],
    prior: &SoilPrior<S>,
) -> Result<MapEstimate<S>, Refusal> {
    identify_up_to::<CAPACITY, S>(wheel, observations, prior)
}

/// The same with room for N observations: the stack grows with it, the answer does not depend on it.
///
/// # Errors
/// As [`identify`], with N in the place of [`CAPACITY`].
pub fn identify_up_to<const N: usize, S: Scalar>(
    wheel: &Wheel<S>,
    observations: &[Observation<S>],
    prior: &SoilPrior<S>,
) -> Result<MapEstimate<S>, Refusal> {
    let unknowns = Unknowns::new(prior, &[])?;
    solve::<N, S>(Forward { wheel, unknowns: &unknowns, model: &BySeed }, observations, &[])
}

/// [`identify`] with effects that the model is told of. `conditions` go with the observations; beyond its end nothing is
/// known.
///
/// # Errors
/// As [`identify`], and where an effect lacks a parameter that is to be fitted.
pub fn identify_declared<S: Scalar>(
    wheel: &Wheel<S>,
    observations: &[Observation<S>],
    conditions: &[Conditions<S>],
    prior: &SoilPrior<S>,
    declared: &DeclaredEffects<S>,
) -> Result<MapEstimate<S>, Refusal> {
    if !declared.is_valid() {
        return Err(Refusal::OutOfRange);
    }
    let unknowns = Unknowns::new(prior, &declared.free)?;
    let model: &dyn Model<S> = if declared.is_none() { &BySeed } else { declared };
    solve::<CAPACITY, S>(Forward { wheel, unknowns: &unknowns, model }, observations, conditions)
}

fn solve<const N: usize, S: Scalar>(
    forward: Forward<'_, S>,
    observations: &[Observation<S>],
    conditions: &[Conditions<S>],
) -> Result<MapEstimate<S>, Refusal> {
    check(forward.wheel, observations, 1, Weighed::AllMeasured)?;
    if observations.len() > N {
        return Err(Refusal::TooMany { room: u8::try_from(N).unwrap_or(u8::MAX) });
    }
    let problem = Problem { forward, observations, conditions, blur: S::one() };
    let mode = best_mode::<N, S>(&problem)?;
    let degrees_of_freedom = problem.degrees_of_freedom();
    let misfit = Misfit { degrees_of_freedom, widened: birge_ratio(mode.fit.cost, degrees_of_freedom) };
    let moments = if misfit.widened > S::one() {
        let doubtful = Problem { blur: misfit.widened, ..problem };
        moments(&doubtful, &mode_nearby(&doubtful, &mode.fit).ok_or(Refusal::NoSoilFits)?)
    } else {
        moments(&problem, &mode.fit)
    };
    Ok(estimate(&problem, &mode, &moments, &misfit))
}

/// What the mode leaves unexplained.
struct Misfit<S> {
    degrees_of_freedom: u16,
    widened: S,
}

fn estimate<S: Scalar, const N: usize>(
    problem: &Problem<'_, S>,
    mode: &Descent<S, N>,
    moments: &Moments<S>,
    misfit: &Misfit<S>,
) -> MapEstimate<S> {
    let unknowns = problem.forward.unknowns;
    let at = |numbers: &[S], place: usize| numbers.get(place).copied().unwrap_or(S::zero());
    let fitted = |place: usize| Fitted { mean: at(&moments.mean, place), std: at(&moments.std, place) };
    MapEstimate {
        identified: identified(problem, &mode.fit, &fitted),
        ln_cohesion: fitted(COHESION),
        friction_angle_rad: fitted(FRICTION),
        ln_shear_modulus: fitted(MODULUS),
        sinkage_exponent: fitted(EXPONENT),
        ln_stiffness: fitted(STIFFNESS),
        peak_stress_c1: fitted(C1),
        peak_stress_c2: fitted(C2),
        effects: (0..unknowns.effects).map(fitted).collect(),
        soil: unknowns.soil(&moments.mean, |value| value),
        mode: unknowns.soil_at(&mode.fit.state.point),
        chi_squared: mode.fit.chi_squared,
        residuals: problem.residuals(),
        misfit: mode.fit.cost,
        degrees_of_freedom: misfit.degrees_of_freedom,
        widened: misfit.widened,
        iterations: mode.steps + moments.steps,
        settled: mode.settled,
    }
}

/// 1 where a misfit could be chance.
fn birge_ratio<S: Scalar>(misfit: S, degrees_of_freedom: u16) -> S {
    let mean = S::constant(f64::from(degrees_of_freedom));
    if is_beyond_chance(misfit, degrees_of_freedom) { (misfit / mean).sqrt() } else { S::one() }
}

fn identified<S: Scalar, const N: usize>(
    problem: &Problem<'_, S>,
    mode: &Fit<S, N>,
    fitted: &impl Fn(usize) -> Fitted<S>,
) -> Identified<S> {
    let unknowns = problem.forward.unknowns;
    let usual = SoilPrior::<S>::usual();
    let told = |place: usize, usual: S, is_logarithm: bool| {
        let Fitted { mean, std } = fitted(place);
        let (value, own_std) = if is_logarithm {
            let growth = (std * std).exp();
            (mean.exp(), mean.exp() * (growth * (growth - S::one())).sqrt())
        } else {
            (mean, std)
        };
        if unknowns.is_known(place) {
            return Told::assumed(value, S::zero());
        }
        let believed = unknowns.beliefs.get(place).map_or(usual, |belief| belief.spread()).min(usual);
        let mut told = Told::estimated(value, Some(own_std), std / believed);
        let (low, high) = unknowns.bounds(place);
        told.identifiable &= mode.state.point.get(place).is_some_and(|at| *at > low && *at < high);
        told
    };
    Identified {
        cohesion_pa: told(COHESION, usual.ln_cohesion.spread(), true),
        friction_angle_rad: told(FRICTION, usual.friction_angle_rad.spread(), false),
        shear_modulus_m: told(MODULUS, usual.ln_shear_modulus.spread(), true),
        condition_number: condition_number(problem, mode),
    }
}
