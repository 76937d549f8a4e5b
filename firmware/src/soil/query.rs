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
    check(fifth.value.is_finite() && positive(fifth.std), &[fifth.value, fifth.std])?;
    let input = query.wheel_inputs(state, fifth);
    let table = &frozen::WHEEL;
    let outputs = table.outputs(&input);
    let inside = table.normalisation.contains(&input) && is_known_slip(state.slip, query.noise.slip);
    Ok(SoilEstimate::of_outputs(&table.posterior, &outputs, inside))
}

/// The soil under all wheels of the query.
fn rover_soil(query: &SoilQuery) -> Result<SoilEstimate, Refusal> {
    let (outputs, inside) = rover_outputs(query)?;
    let inside = inside && query.wheels.iter().all(|state| is_known_slip(state.slip, query.noise.slip));
    Ok(SoilEstimate::of_outputs(&frozen::ROVER.posterior, &outputs, inside))
}

/// The least slip in the scenes that the networks are trained with.
pub const LEAST_SLIP: f64 = 0.02;

/// Whether the networks know wheels at such a slip, which is known to a standard deviation: below the least that they have seen curves are
/// others, and hang on how soil is braked.
pub fn is_known_slip(slip: f32, std: f32) -> bool {
    slip + 3.0 * std >= LEAST_SLIP as f32
}

/// What the rover network says of a query of wheels whose slips are [known](is_known_slip), and whether all of its inputs lie in the training
/// range.
pub(crate) fn rover_outputs(query: &SoilQuery) -> Result<([f32; OUTPUTS], bool), Refusal> {
    check_shared(query)?;
    if query.wheels.is_empty() {
        return Err(Refusal::NoWheels);
    }
    for (state, fifth) in query.wheels.iter().zip(query.sinkage_inputs()) {
        check_state(state)?;
        check(positive(fifth.std), &[fifth.std])?;
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
    check(values.iter().all(|value| positive(*value)), &values)
}

fn check_state(state: &WheelState) -> Result<(), Refusal> {
    let depth = state.sinkage_m.unwrap_or(0.0);
    let values = [state.drawbar_pull_n, state.load_n, state.torque_nm, state.slip, depth];
    let in_range = positive(state.load_n) && (-1.0..=1.0).contains(&state.slip);
    check(in_range && values.iter().all(|value| value.is_finite()), &values)
}

/// Refuses values that are not good, and says why.
fn check(are_good: bool, values: &[f32]) -> Result<(), Refusal> {
    if are_good {
        return Ok(());
    }
    Err(if values.iter().all(|value| value.is_finite()) { Refusal::OutOfRange } else { Refusal::NotFinite })
}

#[cfg(test)]
mod tests {
    use super::{LEAST_SLIP, is_known_slip, wheel_soil};
    use crate::terramechanics::Wheel;
    use crate::wheel_state::{SoilQuery, WheelNoise, WheelState};
    use heapless::Vec;

    #[test]
    fn what_may_be_a_slip_of_the_training_is_known() {
        assert!(is_known_slip(LEAST_SLIP as f32, 0.0) && is_known_slip(0.0, 0.01));
        assert!(!is_known_slip(0.01, 0.003) && !is_known_slip(-0.03, 0.01) && !is_known_slip(f32::NAN, 0.01));
    }

    /// The networks have seen no wheel that is braked a little, and say so.
    #[test]
    fn a_braked_wheel_is_outside_of_what_the_networks_know() {
        let noise = WheelNoise { drawbar_pull_n: 0.5, load_n: 1.0, torque_nm: 0.05, slip: 0.003, sinkage_m: 1.0 };
        let outside = |slip: f32| {
            let state = WheelState { drawbar_pull_n: -4.0, load_n: 65.0, torque_nm: 1.0, slip, sinkage_m: None };
            let wheel = Wheel { radius_m: 0.075, width_m: 0.07 };
            let query = SoilQuery { wheel, noise, slope: None, wheels: Vec::new() };
            wheel_soil(&query, &state).map(|soil| soil.outside_training_range)
        };
        assert_eq!((outside(0.05), outside(-0.01)), (Ok(false), Ok(true)));
    }
}
