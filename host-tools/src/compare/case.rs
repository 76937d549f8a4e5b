//! Cases of a situation: noisy wheel states, and the soil that is under them.

use kapvik_firmware::identification::{Belief, Observation, SoilPrior};
use kapvik_firmware::terramechanics::effects::{Conditions, Effects, SlipSinkage as SlipSinkageEffect};
use kapvik_firmware::terramechanics::{Quadrature, Soil, WheelOnSoil};
use kapvik_firmware::wheel_state::{WHEELS, WheelNoise, WheelState};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::data::campaign::{DeclaredEffect, Knowledge};
use crate::identify::method::{Assumed, Evidence, literature_bank, training_prior};
use crate::prior;
use crate::train::dataset::stream;

use super::situation::{GREATEST_SLIP_SINKAGE, SLIPS, Situation, SlipSinkage, Truth};

/// What a method is asked, and what is true.
#[derive(Debug, Clone)]
pub struct Case {
    /// What is seen, and what is known beforehand.
    pub evidence: Evidence,
    /// The soil.
    pub soil: Soil<f64>,
}

/// Draws of one case before its soil is given up: drawn soils that do not carry the wheels are left out.
const DRAWS: usize = 1000;

/// The case of that place. The same seed gives the same cases, and situations that differ in nothing but the number of
/// instants or in what is declared share soils and loads.
pub fn case(situation: &Situation, seed: u64, place: usize) -> Option<Case> {
    let mut random = stream(seed, place);
    (0..DRAWS).find_map(|_| draw(situation, &mut random))
}

fn draw(situation: &Situation, random: &mut ChaCha8Rng) -> Option<Case> {
    let soil = soil(situation.truth, random)?;
    let n1 = GREATEST_SLIP_SINKAGE * random.random::<f64>();
    let loads: [f64; WHEELS] = std::array::from_fn(|_| {
        prior::KAPVIK_LOAD_N * (1.0 + situation.load_spread * (2.0 * random.random::<f64>() - 1.0))
    });
    let mut effects = Effects::none();
    if situation.slip_sinkage != SlipSinkage::None {
        effects.set(SLIP_SINKAGE, N1, n1);
    }
    let on_soil = WheelOnSoil {
        wheel: &prior::KAPVIK_WHEEL,
        grousers: &prior::KAPVIK_GROUSERS,
        soil: &soil,
        effects: &effects,
        gravity_m_s2: prior::GRAVITY_M_S2,
        quadrature: Quadrature::for_scalar::<f64>(),
    };
    let noise = noise(situation.instants);
    let mut observations = Vec::with_capacity(WHEELS);
    for (place, load_n) in loads.into_iter().enumerate() {
        let slip = SLIPS[0] + (SLIPS[1] - SLIPS[0]) * place as f64 / (WHEELS - 1) as f64;
        let truth = on_soil.at_load(&Conditions::default(), slip, load_n).ok()?;
        if truth.sinkage_m > prior::DEEPEST * prior::KAPVIK_WHEEL.radius_m {
            return None;
        }
        let state = WheelState { load_n, ..truth.into() };
        observations.push(Observation { state: state.blurred(&noise, || StandardNormal.sample(random)), noise });
    }
    let prior = training_prior();
    let declared = if situation.slip_sinkage == SlipSinkage::Declared { vec![declared()?] } else { Vec::new() };
    let evidence = Evidence {
        wheel: prior::KAPVIK_WHEEL,
        grousers: prior::KAPVIK_GROUSERS,
        gravity_m_s2: prior::GRAVITY_M_S2,
        conditions: vec![Conditions::default(); observations.len()],
        observations,
        assumed: Assumed::middle_of(&prior),
        prior,
        bank: literature_bank(),
        declared,
    };
    Some(Case { evidence, soil })
}

/// A soil, or none where it would lie beyond what the networks were trained with.
fn soil(truth: Truth, random: &mut ChaCha8Rng) -> Option<Soil<f64>> {
    let mut any = || prior::any_soil(|| random.random());
    let (from, to) = match truth {
        Truth::Drawn => return Some(any()),
        Truth::Fixed(soil) => return Some(soil),
        Truth::Off { from, to } => (from, to),
    };
    let (drawn, usual) = (any(), SoilPrior::usual());
    let mut off = |belief: Belief<f64>| {
        let distance = belief.spread() * (from + (to - from) * random.random::<f64>());
        belief.mean + if random.random() { distance } else { -distance }
    };
    let cohesion_pa = off(usual.ln_cohesion).exp();
    let friction_angle_rad = off(usual.friction_angle_rad);
    let shear_modulus_m = off(usual.ln_shear_modulus).exp();
    let trained = |range: prior::Range, value: f64| (0.0..=1.0).contains(&range.share(value));
    let known = trained(prior::COHESION_PA, cohesion_pa)
        && trained(prior::FRICTION_ANGLE_RAD, friction_angle_rad)
        && trained(prior::SHEAR_MODULUS_M, shear_modulus_m);
    known.then_some(Soil { cohesion_pa, friction_angle_rad, shear_modulus_m, ..drawn })
}

const SLIP_SINKAGE: &str = <SlipSinkageEffect<f64> as kapvik_firmware::terramechanics::effects::Effect<f64>>::ID;
const N1: &str = "n1";

fn declared() -> Option<DeclaredEffect> {
    let info = kapvik_firmware::terramechanics::effects::effect_info(SLIP_SINKAGE)?;
    let known = Knowledge::Between { min: 0.0, max: GREATEST_SLIP_SINKAGE };
    Some(DeclaredEffect { info, form: None, known: [(N1, known)].into() })
}

/// That of Kapvik's assumed sensors, averaged.
fn noise(instants: u32) -> WheelNoise<f64> {
    let share = 1.0 / f64::from(instants).sqrt();
    prior::KAPVIK_INSTANT_NOISE.map(|std| share * std)
}
