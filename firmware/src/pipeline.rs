//! Wheel states in, soil estimates out: the one function that a board calls for each query.

use crate::soil_estimate::{QueryAnswer, Refusal};
use crate::terramechanics::Wheel;
use crate::wheel_state::{SoilQuery, WheelNoise, WheelState};

/// The soil under each wheel and under the rover.
pub fn answer(query: &SoilQuery) -> QueryAnswer {
    let count = query.wheels.len();
    let common = check_wheel(&query.wheel).and_then(|()| check_noise(&query.noise));
    if let Err(reason) = common {
        return QueryAnswer::refused(count, reason);
    }
    let rover = match query.wheels.iter().try_for_each(check_state) {
        Ok(()) if query.wheels.is_empty() => Refusal::NoWheels,
        Ok(()) => Refusal::NoNetwork,
        Err(reason) => reason,
    };
    let mut answer = QueryAnswer::refused(0, rover);
    for state in &query.wheels {
        answer.push(check_state(state).and(Err(Refusal::NoNetwork)));
    }
    answer
}

fn check_wheel(wheel: &Wheel<f32>) -> Result<(), Refusal> {
    positive(wheel.radius_m)?;
    positive(wheel.width_m)
}

fn check_noise(noise: &WheelNoise) -> Result<(), Refusal> {
    [noise.drawbar_pull_n, noise.load_n, noise.torque_nm, noise.slip, noise.sinkage_m]
        .into_iter()
        .try_for_each(positive)
}

fn check_state(state: &WheelState) -> Result<(), Refusal> {
    finite(state.drawbar_pull_n)?;
    finite(state.torque_nm)?;
    finite(state.slip)?;
    positive(state.load_n)?;
    state.sinkage_m.map_or(Ok(()), finite)?;
    if (-1.0..=1.0).contains(&state.slip) { Ok(()) } else { Err(Refusal::OutOfRange) }
}

fn finite(value: f32) -> Result<(), Refusal> {
    if value.is_finite() { Ok(()) } else { Err(Refusal::NotFinite) }
}

fn positive(value: f32) -> Result<(), Refusal> {
    finite(value)?;
    if value > 0.0 { Ok(()) } else { Err(Refusal::OutOfRange) }
}
