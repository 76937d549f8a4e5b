//! How long a wheel has rolled since it stood: it starts, settles, and then rolls as it will.

use crate::scalar::Scalar;

/// A wheel has started after so long, s.
const STARTING_S: f64 = 0.75;
/// After so long its wandering is learned afresh, s; and it rolls as it will a tenth of a second later, give or take half of that.
const SETTLING_S: f64 = 1.85;
const STEADY_S: f64 = 1.95;
/// A longer step counts as so long, s: to start takes some frames, too.
const LONGEST_STEP_S: f64 = 0.25;

/// The time since a wheel last stood, s, up to when it rolls as it will.
#[derive(Debug, Clone, Copy)]
pub(super) struct SinceStart<S> {
    rolls_s: S,
}

impl<S: Scalar> SinceStart<S> {
    /// It stands.
    pub fn standing() -> Self {
        Self { rolls_s: S::zero() }
    }

    /// Takes whether it stands in a frame that is so long, s, after the one before. True in the frame in which it has settled.
    pub fn follow(&mut self, stands: bool, step_s: S) -> bool {
        let settled = self.has_settled();
        let rolls_s = self.rolls_s + step_s.min(S::constant(LONGEST_STEP_S));
        self.rolls_s = if stands { S::zero() } else { rolls_s.min(S::constant(STEADY_S)) };
        !settled && self.has_settled()
    }

    /// Whether it stands, or has just started.
    pub fn starts(&self) -> bool {
        self.rolls_s < S::constant(STARTING_S)
    }

    /// Whether its start is over.
    pub fn has_settled(&self) -> bool {
        self.rolls_s >= S::constant(SETTLING_S)
    }

    /// Whether it rolls as it will.
    pub fn is_steady(&self) -> bool {
        self.rolls_s >= S::constant(STEADY_S)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wheel_starts_settles_once_and_starts_again() {
        let mut wheel = SinceStart::<f64>::standing();
        assert!(wheel.starts() && !wheel.follow(true, 0.1));
        let settles: Vec<usize> = (1..40).filter(|_| wheel.follow(false, 0.1)).collect();
        assert_eq!(settles, [19]);
        assert!(wheel.is_steady() && wheel.has_settled() && !wheel.starts());
        assert!(!wheel.follow(true, 0.1) && wheel.starts() && !wheel.is_steady());
    }

    #[test]
    fn a_long_step_is_no_start() {
        let mut wheel = SinceStart::<f64>::standing();
        assert!(!wheel.follow(false, 60.0) && wheel.starts());
    }
}
