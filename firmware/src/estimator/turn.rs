//! How the body turns, which carries the velocity of its midpoint over to the ends of the differential axis.

use super::silence::Silence;
use crate::rover::SensorNoise;
use crate::scalar::Scalar;

/// What the body may turn at while its gyro is silent, rad/s.
const UNSEEN: f64 = 0.03;
/// A gyro that has been silent for so long is not awaited any more, s: between two frames of ten a second, so that rounding decides nothing.
/// For a shorter while the velocimeter is rather not asked: a noise that is another in each frame would hide how fast slips wander, and be
/// followed as their trend.
const GYRO_AWAITED_S: f64 = 0.95;

/// The turning about one axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turn<S> {
    /// Of the gyro.
    silence: Silence<S>,
}

impl<S: Scalar> Turn<S> {
    /// Nothing was heard of it.
    pub fn new() -> Self {
        Self { silence: Silence::of(GYRO_AWAITED_S) }
    }

    /// The velocity, m/s, at an end that is `arm_m` from the midpoint, of which the velocimeter says `velocity_m_s` and the gyro this rate,
    /// rad/s; and its standard deviation. Of a gyro that is not awaited any more the body is taken to be still, and to be off by what it may
    /// turn at.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn at_end(
        &mut self,
        velocity_m_s: Option<S>,
        rate_rad_s: Option<S>,
        arm_m: S,
        step_s: S,
        noise: &SensorNoise<S>,
    ) -> (Option<S>, S) {
        self.silence.follow(rate_rad_s.is_some(), step_s);
        let is_told = rate_rad_s.is_some() || self.silence.lasts(GYRO_AWAITED_S);
        let turn_std = arm_m * if rate_rad_s.is_some() { noise.gyro_rad_s } else { S::constant(UNSEEN) };
        let by_turning = rate_rad_s.unwrap_or(S::zero()) * arm_m;
        let at_end = velocity_m_s.filter(|_| is_told).map(|velocity| velocity + by_turning);
        (at_end, (noise.velocity_m_s * noise.velocity_m_s + turn_std * turn_std).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::Turn;
    use crate::rover::Rover;

    /// While the gyro misses frames the velocimeter is left out with it; of one that is silent for good the body may turn.
    #[test]
    fn a_velocity_is_carried_over_with_the_gyro_or_long_without() {
        let noise = Rover::<f64>::assumed().noise;
        let mut turn = Turn::new();
        let mut at_end = |rate| turn.at_end(Some(0.02), rate, -0.4, 0.1, &noise);
        let (never_heard, wide) = at_end(None);
        assert_eq!(never_heard, Some(0.02));
        assert!(wide > 0.4 * 0.029, "{wide}");
        let (heard, narrow) = at_end(Some(0.01));
        assert_eq!(heard, Some(0.02 - 0.004));
        assert!(narrow < 2.0 * noise.velocity_m_s, "{narrow}");
        let silent: Vec<_> = (0..12).map(|_| at_end(None).0).collect();
        assert!(silent.iter().take(8).all(Option::is_none), "{silent:?}");
        assert_eq!(silent.last(), Some(&Some(0.02)));
    }
}
