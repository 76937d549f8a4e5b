//! What acts beside the seed's equations, and which of its parameters are fitted along.

use heapless::Vec;

use crate::identification::Belief;
use crate::scalar::Scalar;
use crate::terramechanics::effects::{Effects, Grousers};

use super::unknowns::EFFECT_PARAMETERS;

/// A parameter of an effect that is fitted along with the soil.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeParameter<S> {
    /// The effect's id.
    pub effect: &'static str,
    /// The parameter's name.
    pub parameter: &'static str,
    /// What is believed of it, in its own unit.
    pub belief: Belief<S>,
}

/// Effects that the model is told of.
///
/// Each observation is taken by itself: an effect that remembers (the lag of the sinkage) sees the start of a run in each.
/// Effects of the load see the measured load.
#[derive(Debug, Clone, PartialEq)]
pub struct DeclaredEffects<S> {
    /// The effects, with the values of the parameters that are not fitted.
    pub effects: Effects<S>,
    /// The parameters that are fitted.
    pub free: Vec<FreeParameter<S>, EFFECT_PARAMETERS>,
    /// The grousers of the wheel.
    pub grousers: Grousers<S>,
    /// Gravity, m/s².
    pub gravity_m_s2: S,
}

impl<S: Scalar> DeclaredEffects<S> {
    /// The seed's equations 1–11, of a smooth wheel on Earth.
    pub fn none() -> Self {
        Self { effects: Effects::none(), free: Vec::new(), grousers: Grousers::none(), gravity_m_s2: S::constant(9.81) }
    }

    /// Whether nothing acts.
    pub(super) fn is_none(&self) -> bool {
        self.effects.ids().next().is_none() && self.free.is_empty()
    }

    /// Whether the effects have the parameters that are to be fitted.
    pub(super) fn is_valid(&self) -> bool {
        let mut effects = self.effects;
        self.free.iter().all(|free| effects.set(free.effect, free.parameter, free.belief.mean))
    }
}
