//! Which number it is that a method does not take.

use kapvik_firmware::identification::Observation;

use crate::data::campaign::Channel;

use super::{Evidence, Method};

/// The first number of the evidence that is outside what the method takes, and what was expected; none where all are inside.
pub fn named(method: Method, evidence: &Evidence) -> Option<String> {
    let sunk = |seen: &Observation<f64>| of_contact(seen, evidence.wheel.radius_m).filter(|_| method.needs_contact());
    evidence
        .observations
        .iter()
        .find_map(|seen| of_noise(method, seen).or_else(|| of_state(seen)).or_else(|| sunk(seen)))
}

fn of_noise(method: Method, seen: &Observation<f64>) -> Option<String> {
    let noise = &seen.noise;
    let spreads = [
        (Channel::DrawbarPull, noise.drawbar_pull_n),
        (Channel::Load, noise.load_n),
        (Channel::Torque, noise.torque_nm),
        (Channel::Slip, noise.slip),
        (Channel::Sinkage, noise.sinkage_m),
    ];
    let was_measured = |channel: Channel, std: f64| match channel {
        Channel::Sinkage => seen.state.sinkage_m.is_some(),
        _ => std != f64::INFINITY || method.needs().contains(&channel),
    };
    let is_weighed = |channel, std| method.weighs().contains(&channel) && was_measured(channel, std);
    let (channel, std) = spreads.into_iter().find(|(channel, std)| is_weighed(*channel, *std) && !is_size(*std))?;
    let name = channel.name();
    Some(format!("the noise of {name} is {std}: the method weighs by it, and expects a standard deviation above 0"))
}

fn of_state(seen: &Observation<f64>) -> Option<String> {
    let state = &seen.state;
    let load =
        (!is_size(state.load_n)).then(|| format!("a load_n of {}: the method expects one above 0 N", state.load_n));
    let slip = !(-1.0..=1.0).contains(&state.slip);
    load.or(slip.then(|| format!("a slip of {}: the method expects one from −1 to 1", state.slip)))
}

/// Of a wheel that drives: such methods leave others out.
fn of_contact(seen: &Observation<f64>, radius_m: f64) -> Option<String> {
    let sinkage_m = seen.state.sinkage_m.filter(|_| seen.state.slip >= 0.0)?;
    let is_in_range = sinkage_m > 0.0 && sinkage_m <= radius_m;
    (!is_in_range)
        .then(|| format!("a sinkage_m of {sinkage_m}: the method expects one above 0 and at most {radius_m} m"))
}

fn is_size(number: f64) -> bool {
    number > 0.0 && number.is_finite()
}
