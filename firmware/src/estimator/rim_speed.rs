//! How fast the rims of a side turn.

use super::silence::{AWAITED_S, Silence};
use crate::rover::PerAxle;
use crate::scalar::Scalar;

/// The speed of the rims against their links: the median of what encoders there are, so that one blocked wheel does not matter.
#[derive(Debug, Clone, Copy)]
pub(super) struct RimSpeed<S> {
    speed_m_s: S,
    /// Of all encoders together.
    silence: Silence<S>,
}

impl<S: Scalar> RimSpeed<S> {
    /// Rims that stand, of encoders of which nothing is to be awaited.
    pub fn unheard() -> Self {
        Self { speed_m_s: S::zero(), silence: Silence::of(AWAITED_S) }
    }

    /// It, m/s.
    pub fn speed_m_s(&self) -> S {
        self.speed_m_s
    }

    /// Whether any encoder spoke in the last frame.
    pub fn are_heard(&self) -> bool {
        self.silence.is_over()
    }

    /// Takes the speeds of a frame, m/s, and how fast the side is, as the velocimeter has it: rims of which nothing is heard for long are
    /// about as fast.
    pub fn follow(&mut self, step_s: S, rims_m_s: &PerAxle<Option<S>>, side_m_s: Option<S>) {
        self.silence.follow(rims_m_s.as_array().into_iter().any(Option::is_some), step_s);
        self.speed_m_s = match (rims_m_s.front, rims_m_s.middle, rims_m_s.rear) {
            (Some(a), Some(b), Some(c)) => a.min(b).max(a.max(b).min(c)),
            (Some(a), Some(b), None) | (Some(a), None, Some(b)) | (None, Some(a), Some(b)) => {
                (a + b) * S::constant(0.5)
            }
            (Some(a), None, None) | (None, Some(a), None) | (None, None, Some(a)) => a,
            (None, None, None) => side_m_s.filter(|_| self.silence.lasts(AWAITED_S)).unwrap_or(self.speed_m_s),
        };
    }
}

#[cfg(test)]
mod tests {
    use super::{PerAxle, RimSpeed};

    #[test]
    fn rims_are_heard_then_awaited_then_taken_to_be_as_fast_as_the_rover() {
        let mut rims = RimSpeed::<f64>::unheard();
        let silent = PerAxle::all(None);
        let mut speed = |front, middle, rear| {
            rims.follow(0.1, &PerAxle { front, middle, rear }, Some(0.015));
            rims.speed_m_s()
        };
        assert_eq!(speed(None, None, None), 0.015, "never heard");
        assert_eq!(speed(Some(0.02), Some(0.0), Some(0.03)), 0.02, "one is blocked");
        assert_eq!(speed(Some(0.02), None, Some(0.03)), 0.025);
        assert!((0..49).all(|_| speed(None, None, None) == 0.025), "awaited");
        assert_eq!(speed(None, None, None), 0.015);
        rims.follow(0.1, &silent, None);
        assert_eq!(rims.speed_m_s(), 0.015, "nothing is heard at all");
        assert!(!rims.are_heard());
        rims.follow(0.1, &PerAxle { rear: Some(0.02), ..silent }, None);
        assert!(rims.are_heard());
    }
}
