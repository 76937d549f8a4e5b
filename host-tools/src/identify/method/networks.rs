//! The frozen networks.

use kapvik_firmware::pipeline;
use kapvik_firmware::wheel_state::{SoilQuery, WHEELS, WheelNoise};

use crate::identify::sensor_noise::noise_for_networks;

use super::{Evidence, Finding, network_refusal};

/// What the rover network says of all wheels together.
///
/// # Errors
/// The network's refusal, in words.
pub fn rover(evidence: &Evidence) -> Result<Finding, String> {
    let estimate = pipeline::answer(&query(evidence)).rover;
    estimate.map(|estimate| Finding::from(&estimate)).map_err(|refusal| network_refusal(refusal).to_owned())
}

/// What the per-wheel network says of the wheel in the middle of the evidence.
///
/// # Errors
/// The network's refusal, in words.
pub fn one_wheel(evidence: &Evidence) -> Result<Finding, String> {
    let answer = pipeline::answer(&query(evidence));
    let estimate = answer.wheels.get(answer.wheels.len() / 2).ok_or("there is no wheel")?;
    estimate.map(|estimate| Finding::from(&estimate)).map_err(|refusal| network_refusal(refusal).to_owned())
}

/// The first six observations as a query to the networks.
pub fn query(evidence: &Evidence) -> SoilQuery {
    let seen = || evidence.observations.iter().take(WHEELS);
    let noises: Vec<WheelNoise<f64>> = seen().map(|one| one.noise).collect();
    let mean_load_n = seen().map(|one| one.state.load_n).sum::<f64>() / noises.len() as f64;
    SoilQuery {
        wheel: evidence.wheel.map(|length| length as f32),
        noise: noise_for_networks(&noises, mean_load_n, evidence.wheel.radius_m),
        slope: None,
        wheels: seen().map(|one| one.state.map(|number| number as f32)).collect(),
    }
}
