//! Wheel states in, soil out: the one function that a board calls.

use heapless::Vec;

use crate::frozen;
use crate::network::WHEEL_INPUTS;
use crate::soil::{QueryAnswer, Refusal, SoilEstimate, context_features, wheel_features};
use crate::terramechanics::Wheel;
use crate::wheel_state::{SoilQuery, WheelNoise, WheelState};

/// Estimates the soil. Every number that comes out is finite, whatever comes in.
pub fn answer(query: &SoilQuery) -> QueryAnswer {
    let mut answer = QueryAnswer { wheels: Vec::new(), rover: estimate_rover(query) };
    query.wheels.iter().for_each(|state| answer.push(estimate_wheel(query, state)));
    answer
}

/// The soil under one wheel.
pub fn estimate_wheel(query: &SoilQuery, state: &WheelState) -> Result<SoilEstimate, Refusal> {
    check_shared(&query.wheel, &query.noise)?;
    check_state(state, false)?;
    let own = wheel_features(&query.wheel, state, false);
    let shared = context_features(&query.wheel, &query.noise, state.load_n, false);
    let mut input = [0.0; WHEEL_INPUTS];
    input.iter_mut().zip(own.iter().chain(&shared)).for_each(|(place, value)| *place = *value);
    let table = &frozen::WHEEL;
    let posterior = table.posterior.read(&table.outputs(&input));
    Ok(SoilEstimate::new(&posterior, table.normalisation.contains(&input)))
}

/// The soil under all wheels of the query.
pub fn estimate_rover(query: &SoilQuery) -> Result<SoilEstimate, Refusal> {
    check_shared(&query.wheel, &query.noise)?;
    let sinkage = query.has_sinkage();
    if query.wheels.is_empty() {
        return Err(Refusal::NoWheels);
    }
    query.wheels.iter().try_for_each(|state| check_state(state, sinkage))?;
    if sinkage && !positive(query.noise.sinkage_m) {
        return Err(Refusal::OutOfRange);
    }
    let context = context_features(&query.wheel, &query.noise, query.mean_load_n(), sinkage);
    let features = query.wheels.iter().map(|state| wheel_features(&query.wheel, state, sinkage));
    let table = &frozen::ROVER;
    let posterior = table.posterior.read(&table.outputs(&context, features.clone()));
    let inside = table.context.contains(&context) && features.into_iter().all(|wheel| table.wheel.contains(&wheel));
    Ok(SoilEstimate::new(&posterior, inside))
}

fn positive(value: f32) -> bool {
    value > 0.0 && value.is_finite()
}

fn check_shared(wheel: &Wheel<f32>, noise: &WheelNoise) -> Result<(), Refusal> {
    let values = [wheel.radius_m, wheel.width_m, noise.drawbar_pull_n, noise.load_n, noise.torque_nm, noise.slip];
    check(values.iter().all(|value| value.is_finite()), values.iter().all(|&value| positive(value)))
}

fn check_state(state: &WheelState, sinkage: bool) -> Result<(), Refusal> {
    let depth = state.sinkage_m.filter(|_| sinkage).unwrap_or(0.0);
    let values = [state.drawbar_pull_n, state.load_n, state.torque_nm, state.slip, depth];
    let in_range = positive(state.load_n) && (-1.0..=1.0).contains(&state.slip);
    check(values.iter().all(|value| value.is_finite()), in_range)
}

fn check(finite: bool, in_range: bool) -> Result<(), Refusal> {
    match (finite, in_range) {
        (false, _) => Err(Refusal::NotFinite),
        (true, false) => Err(Refusal::OutOfRange),
        (true, true) => Ok(()),
    }
}
