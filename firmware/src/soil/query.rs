//! Wheel states in, soil out.

use heapless::Vec;

use crate::frozen;
use crate::network::OUTPUTS;
use crate::wheel_state::{SoilQuery, WheelState};

use super::{FifthInput, QueryAnswer, Refusal, SoilEstimate};

/// Estimates the soil. Every number that comes out is finite, whatever comes in.
pub fn answer(query: &SoilQuery) -> QueryAnswer {
    let mut answer = QueryAnswer { wheels: Vec::new(), rover: rover_soil(query) };
    query.wheels.iter().for_each(|state| answer.push(wheel_soil(query, state)));
    answer
}

/// The soil under one wheel of a query.
pub(crate) fn wheel_soil(query: &SoilQuery, state: &WheelState) -> Result<SoilEstimate, Refusal> {
    check_shared(query)?;
    check_state(&WheelState { sinkage_m: None, ..*state })?;
    let fifth = FifthInput::slope(query.slope);
    check(fifth.value.is_finite() && fifth.std.is_finite(), fifth.std > 0.0)?;
    let input = query.wheel_inputs(state, fifth);
    let table = &frozen::WHEEL;
    let posterior = table.posterior.read(&table.outputs(&input));
    Ok(SoilEstimate::new(&posterior, table.normalisation.contains(&input)))
}

/// The soil under all wheels of the query.
fn rover_soil(query: &SoilQuery) -> Result<SoilEstimate, Refusal> {
    let (outputs, inside) = rover_outputs(query)?;
    Ok(SoilEstimate::new(&frozen::ROVER.posterior.read(&outputs), inside))
}

/// What the rover network says of a query, and whether all of its inputs lie in the training range.
pub(crate) fn rover_outputs(query: &SoilQuery) -> Result<([f32; OUTPUTS], bool), Refusal> {
    check_shared(query)?;
    if query.wheels.is_empty() {
        return Err(Refusal::NoWheels);
    }
    for (state, fifth) in query.wheels.iter().zip(query.sinkage_inputs()) {
        check_state(state)?;
        check(fifth.std.is_finite(), fifth.std > 0.0)?;
    }
    let (context, wheels) = query.rover_features();
    let table = &frozen::ROVER;
    let outputs = table.outputs(&context, wheels.iter().copied());
    let inside = table.context.contains(&context) && wheels.iter().all(|wheel| table.wheel.contains(wheel));
    Ok((outputs, inside))
}

fn positive(value: f32) -> bool {
    value > 0.0 && value.is_finite()
}

fn check_shared(query: &SoilQuery) -> Result<(), Refusal> {
    let SoilQuery { wheel, noise, .. } = query;
    let values = [wheel.radius_m, wheel.width_m, noise.drawbar_pull_n, noise.load_n, noise.torque_nm, noise.slip];
    check(values.iter().all(|value| value.is_finite()), values.iter().all(|&value| positive(value)))
}

fn check_state(state: &WheelState) -> Result<(), Refusal> {
    let depth = state.sinkage_m.unwrap_or(0.0);
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
