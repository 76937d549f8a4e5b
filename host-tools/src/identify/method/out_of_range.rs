//! Which number it is that no method takes.

use kapvik_firmware::identification::Observation;

use crate::data::campaign::Channel;

use super::Evidence;

/// The first number of the evidence that is outside what any method takes, and what was expected; none where all are inside.
pub fn named(evidence: &Evidence) -> Option<String> {
    evidence.observations.iter().find_map(of_observation)
}

fn of_observation(seen: &Observation<f64>) -> Option<String> {
    let (state, noise) = (&seen.state, &seen.noise);
    let spreads = [
        (Channel::DrawbarPull, noise.drawbar_pull_n),
        (Channel::Load, noise.load_n),
        (Channel::Torque, noise.torque_nm),
        (Channel::Slip, noise.slip),
    ];
    let spread = spreads.into_iter().find(|(_, std)| !is_size(*std));
    let spread = spread.map(|(channel, std)| {
        format!(
            "the noise of {} is {std}: the method weighs by it, and expects a standard deviation above 0",
            channel.name()
        )
    });
    let load =
        (!is_size(state.load_n)).then(|| format!("a load_n of {}: the method expects one above 0 N", state.load_n));
    let slip = !(-1.0..=1.0).contains(&state.slip);
    let slip = slip.then(|| format!("a slip of {}: the method expects one from −1 to 1", state.slip));
    spread.or(load).or(slip)
}

fn is_size(number: f64) -> bool {
    number > 0.0 && number.is_finite()
}
