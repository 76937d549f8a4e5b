//! What the force channels say by themselves, without a model of wheel and soil.
//!
//! A load that a dead weight sets is known but for its sensor: where the loads of a campaign come in levels, the reading less
//! its level is a residual in its own right. So is the side force of a wheel that runs straight. Both are held against what
//! sensors are known to follow; braking rows count as well, for they show large horizontal forces.

mod jackknife;
mod load_channel;
mod load_levels;
mod regression;
mod select;
mod side_channel;
mod sources;

use crate::data::campaign::Campaign;

use super::document::FoundEffect;

/// What the force channels say by themselves.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ForceChannels {
    /// Effects on the load or the side force, in the order in which they were found, the load's first.
    pub effects: Vec<FoundEffect>,
    /// What these readings cannot tell apart, sentence by sentence.
    pub caveats: Vec<String>,
}

/// The effects that load and side force show by themselves; none where the loads come in no levels, the wheel runs at a slip
/// angle, or there are too few runs.
pub fn force_channels(campaign: &Campaign) -> Vec<FoundEffect> {
    examine(campaign).effects
}

/// As [`force_channels`], with what these readings cannot tell apart.
pub fn examine(campaign: &Campaign) -> ForceChannels {
    let channels = [load_channel::load_channel(campaign), side_channel::side_channel(campaign)];
    let problems: Vec<_> = channels.into_iter().flatten().collect();
    // One family: what is tried on one channel makes chance finds on the other no rarer.
    let tried = problems.iter().map(|problem| problem.terms.len()).sum();
    let mut found = ForceChannels::default();
    for problem in &problems {
        let of_channel = select::select(problem, tried);
        found.effects.extend(of_channel.effects);
        found.caveats.extend(of_channel.caveats);
    }
    found
}

#[cfg(test)]
mod tests;
