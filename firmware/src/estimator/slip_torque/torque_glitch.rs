//! Whether what a drive says of its torque is a glitch.
//!
//! A torque that jumps either turns its wheel faster, which the encoder shows at once, or meets as much more from the soil, and then stays.
//! One that does neither is a reading that is off. Believed, it speaks against the encoder first, and then as a moment on the links: one frame
//! in twenty was enough for pulls to be off by fifty newtons. So a jump without an answer is left out for a frame; it counts from the next on
//! that says the same. On simulated drives over plane ground, hills, slopes, rocks and other soils none is left out; where a wheel blocks,
//! it is here and there the first of a climb.

use super::SlipTorqueFilter;
use crate::scalar::Scalar;

/// What a torque of Kapvik's changes by beside its noise, N·m over a metre, in a step that is not longer than a contact, m.
const STEEPEST_NM_PER_M: f64 = 80.0;
const CONTACT_M: f64 = 0.03;
/// And its noise, in standard deviations of one reading.
const BY_NOISE: f64 = 6.0;
/// A change of more than this part of that goes on.
const CLIMBS: f64 = 0.5;
/// An encoder answers that shows this part of what a jump would do to its rate.
const ANSWERS: f64 = 0.5;

/// Which torques of a drive were believed.
#[derive(Debug, Clone, Copy)]
pub(super) struct TorqueGlitch<S> {
    /// The last that was, N·m; none where the last frame had none.
    believed_nm: Option<S>,
    /// By how much it had changed, N·m.
    changed_nm: S,
    /// What was not, in the last frame, N·m.
    denied_nm: Option<S>,
    /// Whether what was said in the frame before that was not, either.
    again: bool,
}

impl<S: Scalar> TorqueGlitch<S> {
    /// Nothing was said yet.
    pub fn new() -> Self {
        Self { believed_nm: None, changed_nm: S::zero(), denied_nm: None, again: false }
    }

    /// What was not believed in the last frame, N·m, where the torque may swing: nor was it in the frame before.
    pub fn may_swing_nm(&self) -> Option<S> {
        self.denied_nm.filter(|_| self.again)
    }

    /// Believes whatever is said.
    fn believe(&mut self, torque_nm: Option<S>) {
        let changed_nm = torque_nm.zip(self.believed_nm).map_or(S::zero(), |(now, before)| now - before);
        *self = Self { believed_nm: torque_nm, changed_nm, ..Self::new() };
    }

    /// Whether a torque is a glitch: farther than `limit_nm` from the last that was believed, without an answer to what it has jumped by, and
    /// neither a step that was denied in the frame before nor a climb that goes on.
    fn is_glitch(&mut self, torque_nm: S, limit_nm: S, is_answered: impl FnOnce(S) -> bool) -> bool {
        let Some(before) = self.believed_nm else { return false };
        let jump = torque_nm - before;
        let same_way = |change: S| jump * change > S::zero();
        let stays = |denied: S| same_way(denied - before) && jump.abs() > (denied - before).abs() - limit_nm;
        let climbs = same_way(self.changed_nm) && self.changed_nm.abs() > S::constant(CLIMBS) * limit_nm;
        if jump.abs() <= limit_nm || climbs || self.denied_nm.is_some_and(stays) || is_answered(jump) {
            return false;
        }
        self.again = self.denied_nm.replace(torque_nm).is_some();
        true
    }
}

/// What a drive says in a frame.
#[derive(Debug, Clone, Copy)]
pub(in crate::estimator) struct DriveReadings<S> {
    /// Its torque, N·m.
    pub torque_nm: Option<S>,
    /// One standard deviation of that, N·m.
    pub torque_std_nm: S,
    /// Its encoder, rad/s.
    pub rate_rad_s: Option<S>,
    /// Whether its wheel rolls as it will.
    pub settled: bool,
}

impl<S: Scalar> SlipTorqueFilter<S> {
    /// What the drive says of its torque, N·m, if it is believed, in a step over so much travel.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn believed_torque_nm(&mut self, step_s: S, travel_m: S, readings: &DriveReadings<S>) -> Option<S> {
        let DriveReadings { torque_nm, torque_std_nm, rate_rad_s, settled } = *readings;
        let Some(said_nm) = torque_nm.filter(|_| settled && !self.swings()) else {
            self.glitch.believe(torque_nm);
            return torque_nm;
        };
        let steepest_nm = S::constant(STEEPEST_NM_PER_M) * self.scale.torque * travel_m.min(S::constant(CONTACT_M));
        let [rate_before, ..] = *self.filter.estimate().mean();
        let per_torque = step_s * self.model.inverse_inertia;
        let gained = rate_rad_s.map_or(S::zero(), |rate| rate - self.link_rate_rad_s - rate_before);
        let answers = |jump: S| gained / (per_torque * jump) > S::constant(ANSWERS);
        if self.glitch.is_glitch(said_nm, S::constant(BY_NOISE) * torque_std_nm + steepest_nm, answers) {
            return None;
        }
        self.glitch.believe(torque_nm);
        torque_nm
    }
}

#[cfg(test)]
mod tests {
    use super::TorqueGlitch;

    /// Whether each of some torques is believed, none of them answered by the encoder.
    fn believed(torques: &[f64]) -> Vec<bool> {
        let mut glitch = TorqueGlitch::new();
        let mut is_believed = |torque: f64| {
            let is_glitch = glitch.is_glitch(torque, 0.5, |_| false);
            if !is_glitch {
                glitch.believe(Some(torque));
            }
            !is_glitch
        };
        torques.iter().map(|torque| is_believed(*torque)).collect()
    }

    #[test]
    fn a_spike_is_denied_and_a_step_for_one_frame() {
        assert_eq!(believed(&[1.0, -3.0, 1.1, 1.0]), [true, false, true, true]);
        assert_eq!(believed(&[1.0, 4.0, 4.1, 4.0]), [true, false, true, true]);
        assert_eq!(believed(&[1.0, 4.0, -2.0, 1.0]), [true, false, false, true], "two spikes that are not alike");
        assert_eq!(believed(&[1.0, 1.4, 1.8, 2.2]), [true; 4], "a climb");
        assert_eq!(believed(&[1.0, 2.0, 3.0, 4.5]), [true, false, true, true], "a steep climb");
    }

    #[test]
    fn what_the_encoder_answers_is_believed() {
        let mut glitch = TorqueGlitch::new();
        glitch.believe(Some(1.0));
        assert!(!glitch.is_glitch(4.0, 0.5, |jump| jump == 3.0));
    }

    #[test]
    fn what_is_denied_twice_may_swing() {
        let mut glitch = TorqueGlitch::new();
        glitch.believe(Some(1.0));
        assert!(glitch.is_glitch(4.0, 0.5, |_| false) && glitch.may_swing_nm().is_none());
        assert!(glitch.is_glitch(-4.0, 0.5, |_| false) && glitch.may_swing_nm() == Some(-4.0));
    }
}
