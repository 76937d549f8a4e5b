//! What observations would tell, before they are made: the Cramér–Rao bound of a design.

use crate::identification::observation::{Weighed, check};
use crate::identification::{Belief, Observation, Refusal, SoilPrior};
use crate::scalar::Scalar;
use crate::terramechanics::{Soil, Wheel, sinkage_for_load};

use super::CAPACITY;
use super::by_seed::BySeed;
use super::prediction::{Forward, Latents};
use super::problem::{Problem, State};
use super::unknowns::{COHESION, FRICTION, MODULUS, UNKNOWNS, Unknowns};

/// How well observations of a design would tell the soil, to first order about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foreseen<S> {
    /// One standard deviation of ln c.
    pub ln_cohesion_std: S,
    /// One standard deviation of φ, rad.
    pub friction_angle_std_rad: S,
    /// One standard deviation of ln K.
    pub ln_shear_modulus_std: S,
    /// Correlation of ln c and φ.
    pub cohesion_friction_correlation: S,
}

/// How well wheels at the slips and loads of `design`, seen with its noise, would tell `soil`; of their states only slip
/// and load are used, and whether the sinkage is measured. The wheels obey equations 1–11.
///
/// A normal belief counts as information, a flat one as none, and what is known is known; their means are of no account.
/// With three flat beliefs and no other unknown, and noise of slip and sinkage next to none, this is the bound
/// that C. R. Rao and H. Cramér gave. Means of N instants: the noise over √N.
///
/// # Errors
/// As [`super::identify`]; where the soil does not carry a wheel ([`Refusal::NoSoilFits`]); and where the design leaves
/// something unknown altogether ([`Refusal::NotIdentifiable`]).
pub fn information<S: Scalar>(
    wheel: &Wheel<S>,
    soil: &Soil<S>,
    design: &[Observation<S>],
    prior: &SoilPrior<S>,
) -> Result<Foreseen<S>, Refusal> {
    check(wheel, design, 1, Weighed::All)?;
    if design.len() > CAPACITY {
        return Err(Refusal::TooMany { room: CAPACITY as u8 });
    }
    if !(soil.is_valid() && soil.cohesion_pa > S::zero() && soil.stiffness(wheel.width_m) > S::zero()) {
        return Err(Refusal::OutOfRange);
    }
    let unknowns = Unknowns::new(&about(prior, soil, wheel), &[])?;
    let problem = Problem {
        forward: Forward { wheel, unknowns: &unknowns, model: &BySeed },
        observations: design,
        blur: S::one(),
        conditions: &[],
    };
    let mut latents = heapless::Vec::<_, CAPACITY>::new();
    for observation in design {
        let slip = observation.state.slip;
        let sinkage_m =
            sinkage_for_load(wheel, soil, slip, observation.state.load_n).map_err(|_| Refusal::NoSoilFits)?;
        let own = Latents { ln_sinkage: sinkage_m.ln(), slip };
        latents.push(own).map_err(|_| Refusal::TooMany { room: CAPACITY as u8 })?;
    }
    let fit = problem.evaluate(State { point: [S::zero(); UNKNOWNS], latents }).ok_or(Refusal::NoSoilFits)?;
    let mut triangle = fit.of_observations(S::zero(), |_, _| ());
    for (place, belief) in unknowns.beliefs.iter().enumerate() {
        if belief.std.is_some() {
            triangle.add_alone(place, S::one(), S::zero());
        }
    }
    let triangle = triangle.held(&core::array::from_fn(|place| unknowns.is_known(place)));
    let entry = |a: usize, b: usize| {
        let scale = |place: usize| unknowns.slope(place, &fit.state.point);
        triangle.covariances(a).get(b).map_or(S::zero(), |entry| *entry * scale(a) * scale(b))
    };
    let std = |place: usize| entry(place, place).sqrt();
    let told = (0..UNKNOWNS).all(|place| unknowns.is_known(place) || std(place) > S::zero());
    if !told || !entry(COHESION, FRICTION).is_finite() {
        return Err(Refusal::NotIdentifiable);
    }
    Ok(Foreseen {
        ln_cohesion_std: std(COHESION),
        friction_angle_std_rad: std(FRICTION),
        ln_shear_modulus_std: std(MODULUS),
        cohesion_friction_correlation: entry(COHESION, FRICTION) / (std(COHESION) * std(FRICTION)),
    })
}

/// The beliefs moved so that their means are the soil, as wide as they were.
fn about<S: Scalar>(prior: &SoilPrior<S>, soil: &Soil<S>, wheel: &Wheel<S>) -> SoilPrior<S> {
    let moved = |belief: &Belief<S>, mean: S| {
        if belief.is_known() {
            return Belief::known(mean);
        }
        let half = S::constant(0.5) * (belief.high - belief.low);
        Belief { mean, std: belief.std, low: mean - half, high: mean + half }
    };
    SoilPrior {
        ln_cohesion: moved(&prior.ln_cohesion, soil.cohesion_pa.ln()),
        friction_angle_rad: moved(&prior.friction_angle_rad, soil.friction_angle_rad),
        ln_shear_modulus: moved(&prior.ln_shear_modulus, soil.shear_modulus_m.ln()),
        ln_stiffness: moved(&prior.ln_stiffness, soil.stiffness(wheel.width_m).ln()),
        known_depth_m: prior.known_depth_m,
        sinkage_exponent: moved(&prior.sinkage_exponent, soil.sinkage_exponent),
        peak_stress_c1: moved(&prior.peak_stress_c1, soil.peak_stress_c1),
        peak_stress_c2: moved(&prior.peak_stress_c2, soil.peak_stress_c2),
        rebound_ratio: Belief::known(soil.rebound_ratio),
    }
}
