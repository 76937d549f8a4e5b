//! What a method is given of a wheel.

use crate::scalar::Scalar;
use crate::terramechanics::Wheel;
use crate::wheel_state::{WheelNoise, WheelState};

use super::Refusal;

/// The state of a wheel at an instant, or its mean over many, and how noisy that is.
///
/// Wheels of one rover at one instant, or one wheel at several: to the methods they are the same, one soil seen at
/// several slips and loads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Observation<S> {
    /// What was seen.
    pub state: WheelState<S>,
    /// One standard deviation of each part of it.
    pub noise: WheelNoise<S>,
}

/// Whose noise a method weighs by, or takes its standard deviations from. What it says of the others is of no account to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Weighed {
    /// None: it has its standard deviations from the residuals.
    Nothing,
    /// That of the drawbar pull.
    DrawbarPull,
    /// Those of drawbar pull, load, torque and slip.
    AllButSinkage,
    /// The same, and that of the sinkage where there is one.
    All,
}

/// Checks what every method needs: a wheel with a size, at least `needed` observations, finite numbers, slips of −1 … 1,
/// loads above zero, and so the standard deviations that are weighed by.
///
/// # Errors
/// The reason to refuse.
pub(super) fn check<S: Scalar>(
    wheel: &Wheel<S>,
    observations: &[Observation<S>],
    needed: usize,
    weighed: Weighed,
) -> Result<(), Refusal> {
    if observations.len() < needed {
        return Err(Refusal::TooFew { needed: needed as u8 });
    }
    if !observations.iter().all(Observation::is_finite) {
        return Err(Refusal::NotFinite);
    }
    if wheel.is_valid() && observations.iter().all(|seen| seen.is_in_range() && seen.has_noise(weighed)) {
        Ok(())
    } else {
        Err(Refusal::OutOfRange)
    }
}

impl<S: Scalar> Observation<S> {
    /// Whether the wheel drove, or rolled; not whether it braked.
    pub(super) fn is_driven(&self) -> bool {
        self.state.slip >= S::zero()
    }

    /// The sinkage, m, where it is above zero and at most the wheel's radius.
    pub(super) fn sinkage_on(&self, wheel: &Wheel<S>) -> Result<S, Refusal> {
        let sinkage_m = self.state.sinkage_m.ok_or(Refusal::NoSinkage)?;
        if sinkage_m > S::zero() && sinkage_m <= wheel.radius_m { Ok(sinkage_m) } else { Err(Refusal::OutOfRange) }
    }

    fn is_finite(&self) -> bool {
        let state = &self.state;
        [state.drawbar_pull_n, state.load_n, state.torque_nm, state.slip].iter().all(|number| number.is_finite())
            && state.sinkage_m.is_none_or(Scalar::is_finite)
    }

    fn is_in_range(&self) -> bool {
        self.state.load_n > S::zero() && self.state.slip.abs() <= S::one()
    }

    fn has_noise(&self, weighed: Weighed) -> bool {
        let noise = &self.noise;
        let is_size = |std: S| std > S::zero() && std.is_finite();
        let pull = is_size(noise.drawbar_pull_n);
        let forces = || pull && [noise.load_n, noise.torque_nm, noise.slip].into_iter().all(is_size);
        match weighed {
            Weighed::Nothing => true,
            Weighed::DrawbarPull => pull,
            Weighed::AllButSinkage => forces(),
            Weighed::All => forces() && self.state.sinkage_m.is_none_or(|_| is_size(noise.sinkage_m)),
        }
    }
}
