//! The methods, side by side: each is asked about the same evidence and answers in the same form.

mod answer;
mod bootstrap;
mod cross;
mod evidence;
mod knowledge;
mod limit;
mod literature;
mod map;
pub mod networks;
mod no_soil;
mod out_of_range;
pub mod rebound;
mod rehearsed;
mod words;

use std::borrow::Cow;

use clap::ValueEnum;
use kapvik_firmware::soil::is_known_slip;
use kapvik_firmware::wheel_state::WHEELS;

use crate::data::campaign::{Campaign, Channel};

#[cfg(test)]
pub use answer::told_of_friction_angle;
pub use answer::{Finding, Fit, Statement};
pub use bootstrap::REDRAWS;
pub use evidence::{Assumed, Evidence, MOST_STATES, literature_bank};
pub use knowledge::{FARTHEST, NEAR_NOTHING, soil_prior, training_prior};
pub use map::most_probable_soil;
pub use rehearsed::rehearse;
pub use words::{method_refusal, network_refusal};

/// A method of the literature, or ours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, ValueEnum)]
pub enum Method {
    /// The frozen networks that fly
    Network,
    /// Decoupled analytical identification (L. Ding et al. 2009), least squares over wheels and instants
    Ding,
    /// The same with cohesion and friction angle held within bounds
    DingBounded,
    /// Linearised stress, least squares for c and φ with K assumed (K. Iagnemma et al. 2004)
    Iagnemma,
    /// The same, row after row with forgetting
    IagnemmaRecursive,
    /// Simpson's rule and damped Newton–Raphson for φ, K and stiffness with c assumed (S. Hutangkabodee et al. 2006)
    Hutangkabodee,
    /// Bayesian multiple model over the soil catalogue, without sinkage (L. E. Ray 2009)
    Ray,
    /// The earlier network, one hidden layer, with sinkage (M. Cross et al. 2013)
    Cross,
    /// Maximum a posteriori with errors in variables and exact integrals: ours
    Map,
    /// Mean of the exact posterior by sampling: what no method can beat where its prior is true
    Limit,
}

/// Slip and load.
const SLIP_AND_LOAD: [Channel; 2] = [Channel::Slip, Channel::Load];
/// Drawbar pull and torque.
const PULL_AND_TORQUE: [Channel; 2] = [Channel::DrawbarPull, Channel::Torque];
/// Slip, load, drawbar pull and torque.
const FORCES: [Channel; 4] = [Channel::Slip, Channel::Load, Channel::DrawbarPull, Channel::Torque];
/// The same and the sinkage.
const FORCES_AND_SINKAGE: [Channel; 5] =
    [Channel::Slip, Channel::Load, Channel::DrawbarPull, Channel::Torque, Channel::Sinkage];

impl Method {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::Network,
        Self::Ding,
        Self::DingBounded,
        Self::Iagnemma,
        Self::IagnemmaRecursive,
        Self::Hutangkabodee,
        Self::Ray,
        Self::Cross,
        Self::Map,
        Self::Limit,
    ];

    /// The name on the command line and in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Network => "network",
            Self::Ding => "ding",
            Self::DingBounded => "ding-bounded",
            Self::Iagnemma => "iagnemma",
            Self::IagnemmaRecursive => "iagnemma-recursive",
            Self::Hutangkabodee => "hutangkabodee",
            Self::Ray => "ray",
            Self::Cross => "cross",
            Self::Map => "map",
            Self::Limit => "limit",
        }
    }

    /// Whether what the method states is the noise by its own simpler equations alone, and so has to be rehearsed.
    pub const fn is_simpler(self) -> bool {
        !matches!(self, Self::Network | Self::Map | Self::Limit)
    }

    /// Whether the method takes equations 1–11 for exact, and what it is told for states of a wheel.
    pub const fn is_exact(self) -> bool {
        matches!(self, Self::Map | Self::Limit)
    }

    /// Whether the method's model takes in the effects that a campaign declares.
    pub const fn knows_effects(self) -> bool {
        matches!(self, Self::Map)
    }

    /// A campaign as the method sees it: one that knows no effects is told of none.
    pub fn sees(self, campaign: &Campaign) -> Cow<'_, Campaign> {
        campaign.as_seen(self.knows_effects())
    }

    /// The most states of a run that the method is given.
    pub const fn most_states(self) -> usize {
        match self {
            Self::Network | Self::Limit => WHEELS,
            Self::IagnemmaRecursive => usize::MAX,
            _ => MOST_STATES,
        }
    }

    /// Whether the method knows wheels at such a slip, which is known to a standard deviation.
    pub fn knows_slip(self, slip: f64, std: f64) -> bool {
        self != Self::Network || is_known_slip(slip as f32, std as f32)
    }

    /// The channels by whose noise the method weighs.
    pub const fn weighs(self) -> &'static [Channel] {
        match self {
            Self::Iagnemma | Self::IagnemmaRecursive => &[],
            Self::Hutangkabodee => &[Channel::DrawbarPull],
            Self::Ray => &FORCES,
            _ => &FORCES_AND_SINKAGE,
        }
    }

    /// Whether the method's equations are of a wheel that has sunk: at no sinkage they have no contact.
    pub const fn needs_contact(self) -> bool {
        matches!(self, Self::Ding | Self::DingBounded | Self::Iagnemma | Self::IagnemmaRecursive | Self::Hutangkabodee)
    }

    /// Columns of which the method needs one: what it tells the soil's strength by.
    pub const fn needs_one_of(self) -> &'static [Channel] {
        match self {
            Self::Map => &PULL_AND_TORQUE,
            _ => &[],
        }
    }

    /// The columns without which the method cannot work.
    pub const fn needs(self) -> &'static [Channel] {
        match self {
            Self::Map => &SLIP_AND_LOAD,
            Self::Network | Self::Ray | Self::Limit => &FORCES,
            Self::Ding | Self::DingBounded | Self::Cross => &FORCES_AND_SINKAGE,
            Self::Iagnemma | Self::IagnemmaRecursive => {
                &[Channel::Slip, Channel::Load, Channel::Torque, Channel::Sinkage]
            }
            Self::Hutangkabodee => &[Channel::Slip, Channel::Load, Channel::DrawbarPull, Channel::Sinkage],
        }
    }
}

/// What a method says of the evidence, or why it says nothing.
///
/// # Errors
/// The reason, in words.
pub fn answer(method: Method, evidence: &Evidence) -> Result<Finding, String> {
    let refused = |reason| out_of_range::named(method, evidence).unwrap_or(reason);
    let mut finding = by_itself(method, evidence).map_err(refused)?;
    bootstrap::complete(&mut finding, evidence, |redrawn| by_itself(method, redrawn).ok());
    no_soil::doubt(&mut finding);
    Ok(finding)
}

/// The same without standard deviations that the method does not give by itself.
fn by_itself(method: Method, evidence: &Evidence) -> Result<Finding, String> {
    match method {
        Method::Network => networks::rover(evidence),
        Method::Ding => literature::ding(evidence),
        Method::DingBounded => literature::ding_bounded(evidence),
        Method::Iagnemma => literature::iagnemma(evidence),
        Method::IagnemmaRecursive => literature::iagnemma_recursive(evidence),
        Method::Hutangkabodee => literature::hutangkabodee(evidence),
        Method::Ray => literature::ray(evidence),
        Method::Cross => cross::cross(evidence),
        Method::Map => map::map(evidence),
        Method::Limit => limit::posterior_mean(evidence),
    }
}
