//! Examples for the trainers: normalised inputs, standardised targets.

use kapvik_firmware::network::{
    Normalisation, ROVER_CONTEXT, ROVER_INPUTS, ROVER_WHEELS, TARGETS, WHEEL_FEATURES, WHEEL_INPUTS, rover_inputs,
};
use kapvik_firmware::soil::{RoverContext, WheelFeatures};
use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::wheel_state::SoilQuery;

use super::scene::Scene;

/// Normalised inputs of the per-wheel network.
pub type WheelInput = [f32; WHEEL_INPUTS];

/// Normalised inputs of the rover network.
pub type RoverInput = [f32; ROVER_INPUTS];

/// What the rover network's inputs are made of, in their own units.
#[derive(Debug, Clone)]
pub struct RoverFeatures {
    /// Those that the wheels share.
    pub context: RoverContext,
    /// Those of each wheel.
    pub wheels: heapless::Vec<WheelFeatures, ROVER_WHEELS>,
}

/// An input with what the network should say of it.
#[derive(Debug, Clone)]
pub struct Example<I> {
    /// Normalised input.
    pub input: I,
    /// ln c, φ, ln K on the scale of the prior.
    pub target: [f32; TARGETS],
}

/// ln c, φ, ln K of a scene's soil.
pub fn targets(scene: &Scene) -> [f64; TARGETS] {
    soil_targets(&scene.soil)
}

/// ln c, φ, ln K of a soil.
pub fn soil_targets(soil: &Soil<f64>) -> [f64; TARGETS] {
    [libm::log(soil.cohesion_pa), soil.friction_angle_rad, libm::log(soil.shear_modulus_m)]
}

/// What the rover network's inputs for a query are made of.
pub fn rover_features(query: &SoilQuery) -> RoverFeatures {
    let (context, wheels) = query.rover_features();
    RoverFeatures { context, wheels }
}

/// Normalisation of a set of inputs: mean, standard deviation, and the range that all but one in 5000 lie in, each side
/// widened by a tenth of itself.
pub fn normalisation<'a, const N: usize>(inputs: impl Iterator<Item = &'a [f32; N]>) -> Normalisation<N> {
    let inputs: Vec<_> = inputs.collect();
    let mut normal = Normalisation::ZERO;
    for k in 0..N {
        let mut column: Vec<f32> = inputs.iter().map(|input| input[k]).collect();
        column.sort_by(f32::total_cmp);
        let count = column.len() as f64;
        let mean = column.iter().map(|&x| f64::from(x)).sum::<f64>() / count;
        let variance = column.iter().map(|&x| (f64::from(x) - mean) * (f64::from(x) - mean)).sum::<f64>() / count;
        let cut = column.len() / 10_000;
        let (low, high) = (column[cut], column[column.len() - 1 - cut]);
        let margin = 0.1 * (high - low);
        normal.offset[k] = mean as f32;
        normal.scale[k] = (1.0 / libm::sqrt(variance.max(1e-12))) as f32;
        normal.low[k] = low - margin;
        normal.high[k] = high + margin;
    }
    normal
}

/// Normalisations of the rover network's inputs.
#[derive(Debug, Clone)]
pub struct RoverNormalisation {
    /// Of those that the wheels share.
    pub context: Normalisation<ROVER_CONTEXT>,
    /// Of each wheel's own.
    pub wheel: Normalisation<WHEEL_FEATURES>,
}

impl RoverNormalisation {
    /// From a set of inputs in their own units.
    pub fn new(inputs: &[RoverFeatures]) -> Self {
        Self {
            context: normalisation(inputs.iter().map(|input| &input.context)),
            wheel: normalisation(inputs.iter().flat_map(|input| &input.wheels)),
        }
    }

    /// Inputs on the network's scale.
    pub fn apply(&self, features: &RoverFeatures) -> RoverInput {
        let wheels = features.wheels.iter().map(|wheel| self.wheel.apply(wheel));
        rover_inputs(&self.context.apply(&features.context), wheels)
    }
}
