//! What a method is asked about.

use std::sync::LazyLock;

use kapvik_firmware::identification::{Observation, SoilPrior};
use kapvik_firmware::terramechanics::effects::{Conditions, Form, Grousers};
use kapvik_firmware::terramechanics::{Soil, Wheel};
use kapvik_firmware::wheel_state::WheelState;

use crate::data::campaign::{Campaign, DeclaredEffect};
use crate::identify::SensorNoise;
use crate::identify::combine::MeanState;
use crate::identify::followed::lacking;
use crate::identify::soil_bank::soil_bank;

use super::knowledge::soil_prior;

/// The most states of a run that a method is given, where it is not the six of the networks: finer than that, means lose
/// nothing that their noise does not hide.
pub const MOST_STATES: usize = 24;

/// A wheel's states on one soil, and what is known beforehand.
#[derive(Debug, Clone)]
pub struct Evidence {
    /// The wheel.
    pub wheel: Wheel<f64>,
    /// Its grousers, which act only through a declared effect.
    pub grousers: Grousers<f64>,
    /// Gravity, m/s².
    pub gravity_m_s2: f64,
    /// What was seen.
    pub observations: Vec<Observation<f64>>,
    /// What else is known of each, which declared effects may follow.
    pub conditions: Vec<Conditions<f64>>,
    /// What is believed of the soil.
    pub prior: SoilPrior<f64>,
    /// What is taken as given by the methods that need it.
    pub assumed: Assumed,
    /// The soils that the method of multiple models chooses from.
    pub bank: Vec<Soil<f64>>,
    /// The effects that the model is told of.
    pub declared: Vec<DeclaredEffect>,
}

/// What methods without a prior take as given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Assumed {
    /// The soil.
    pub soil: Soil<f64>,
    /// What is believed to be the error of its c, Pa.
    pub cohesion_std_pa: f64,
    /// What is believed to be the error of its K, m.
    pub shear_modulus_std_m: f64,
}

impl Evidence {
    /// The states of a run of a campaign.
    pub fn of_run(campaign: &Campaign, noise: &SensorNoise, states: &[MeanState]) -> Self {
        let prior = soil_prior(campaign);
        let observation =
            |state: &MeanState| Observation { state: state.mean.wheel_state(), noise: noise.of_mean(state) };
        Self {
            wheel: campaign.wheel,
            grousers: campaign.grousers.of_library(),
            gravity_m_s2: campaign.gravity_m_s2,
            observations: states.iter().map(observation).collect(),
            conditions: states.iter().map(|state| state.mean.conditions).collect(),
            assumed: Assumed::middle_of(&prior),
            prior,
            bank: literature_bank(),
            declared: campaign.declared.effects.clone(),
        }
    }

    /// Whether any state has what a form of an effect follows.
    pub fn has(&self, form: &Form) -> bool {
        self.conditions.iter().any(|conditions| lacking(conditions, form).is_none())
    }

    /// The last states alone.
    pub fn from(&self, first: usize) -> Self {
        Self {
            observations: self.observations.get(first..).unwrap_or(&[]).to_vec(),
            conditions: self.conditions.get(first..).unwrap_or(&[]).to_vec(),
            ..self.clone()
        }
    }

    /// The same where such states were seen, within what a slip and a sinkage can be.
    pub fn seeing(&self, states: impl Iterator<Item = WheelState<f64>>) -> Self {
        let seeing = |(seen, state): (&Observation<f64>, WheelState<f64>)| {
            let (slip, sinkage_m) = (state.slip.clamp(-1.0, 1.0), state.sinkage_m.map(|sinkage_m| sinkage_m.max(0.0)));
            Observation { state: WheelState { slip, sinkage_m, ..state }, noise: seen.noise }
        };
        Self { observations: self.observations.iter().zip(states).map(seeing).collect(), ..self.clone() }
    }
}

/// The soils of the literature.
pub fn literature_bank() -> Vec<Soil<f64>> {
    static BANK: LazyLock<Vec<Soil<f64>>> =
        LazyLock::new(|| soil_bank().unwrap_or_default().into_iter().map(|one| one.soil).collect());
    BANK.clone()
}

impl Assumed {
    /// The middle of what is believed.
    pub fn middle_of(prior: &SoilPrior<f64>) -> Self {
        let (cohesion_pa, shear_modulus_m) = (prior.ln_cohesion.mean.exp(), prior.ln_shear_modulus.mean.exp());
        let soil = Soil {
            sinkage_exponent: prior.sinkage_exponent.mean,
            cohesive_modulus: 0.0,
            frictional_modulus: prior.ln_stiffness.mean.exp(),
            cohesion_pa,
            friction_angle_rad: prior.friction_angle_rad.mean,
            shear_modulus_m,
            peak_stress_c1: prior.peak_stress_c1.mean,
            peak_stress_c2: prior.peak_stress_c2.mean,
            rebound_ratio: prior.rebound_ratio.mean,
        };
        Self {
            soil,
            cohesion_std_pa: cohesion_pa * prior.ln_cohesion.spread(),
            shear_modulus_std_m: shear_modulus_m * prior.ln_shear_modulus.spread(),
        }
    }
}
