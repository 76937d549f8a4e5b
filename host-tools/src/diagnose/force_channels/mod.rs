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

use crate::data::campaign::{Campaign, Channel};

use super::document::FoundEffect;
use super::lone_rows::LoneRow;
use sources::SensorRows;

/// What the force channels say by themselves: the load first, then the side force, where they say anything.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ForceChannels(Vec<ForceChannel>);

/// What one of them says by itself.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceChannel {
    /// The load or the side force.
    pub channel: Channel,
    /// Effects on it, in the order in which they were found.
    pub effects: Vec<FoundEffect>,
    /// What its readings cannot tell apart, sentence by sentence.
    pub caveats: Vec<String>,
}

impl ForceChannels {
    /// Effects on the load or the side force.
    pub fn effects(&self) -> impl Iterator<Item = &FoundEffect> {
        self.0.iter().flat_map(|of_channel| &of_channel.effects)
    }

    /// Effects on one of the two.
    pub fn effects_on(&self, channel: Channel) -> impl Iterator<Item = &FoundEffect> {
        self.0.iter().filter(move |of_channel| of_channel.channel == channel).flat_map(|of_channel| &of_channel.effects)
    }

    /// What these readings cannot tell apart, sentence by sentence.
    pub fn caveats(&self) -> impl Iterator<Item = &String> {
        self.0.iter().flat_map(|of_channel| &of_channel.caveats)
    }
}

/// The effects that load and side force show by themselves, apart from rows that are set aside; none where the loads come in no levels, the
/// wheel runs at a slip angle, or there are too few runs.
pub fn force_channels(campaign: &Campaign, set_aside: &[LoneRow]) -> ForceChannels {
    let rows = SensorRows::of(campaign, set_aside);
    let channels = [load_channel::load_channel(&rows), side_channel::side_channel(&rows)];
    let problems: Vec<_> = channels.into_iter().flatten().collect();
    // One family: what is tried on one channel makes chance finds on the other no rarer.
    let tried = problems.iter().map(|problem| problem.terms.len()).sum();
    ForceChannels(problems.iter().map(|problem| select::select(problem, tried)).collect())
}

#[cfg(test)]
mod tests;
