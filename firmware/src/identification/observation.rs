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
    /// One standard deviation of each part of it. That of a drawbar pull or a torque which was not measured is infinite, and the number in
    /// the state then says nothing: [maximum a posteriori](super::map) alone does without.
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
    /// The same, but those of drawbar pull and torque where these were measured; one of both was.
    AllMeasured,
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
        let (pull, torque) = (is_size(noise.drawbar_pull_n), is_size(noise.torque_nm));
        let load_and_slip = is_size(noise.load_n) && is_size(noise.slip);
        let sinkage = || self.state.sinkage_m.is_none_or(|_| is_size(noise.sinkage_m));
        match weighed {
            Weighed::Nothing => true,
            Weighed::DrawbarPull => pull,
            Weighed::AllButSinkage => pull && torque && load_and_slip,
            Weighed::All => pull && torque && load_and_slip && sinkage(),
            Weighed::AllMeasured => {
                let [no_pull, no_torque] = [noise.drawbar_pull_n, noise.torque_nm].map(is_not_measured);
                (pull || no_pull) && (torque || no_torque) && (pull || torque) && load_and_slip && sinkage()
            }
        }
    }

    /// How many of its parts were measured.
    pub(super) fn readings(&self) -> usize {
        let left_out =
            [self.noise.drawbar_pull_n, self.noise.torque_nm].into_iter().filter(|std| is_not_measured(*std));
        4 + usize::from(self.state.sinkage_m.is_some()) - left_out.count()
    }
}

/// Whether such a standard deviation says that there was no measurement.
fn is_not_measured<S: Scalar>(std: S) -> bool {
    std > S::zero() && !std.is_finite()
}
