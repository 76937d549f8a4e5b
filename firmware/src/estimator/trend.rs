//! How the contact angles turn along the way.
//!
//! A filter that takes an angle for a random walk lags behind one that turns steadily, by the way over which it averages. What its
//! updates move the angle by, time after time the same way, tells the trend; the next angle is expected that much further on
//! (exponential smoothing with a damped trend, Holt 1957; Gardner and McKenzie 1985). Ground of hills and rocks bends one way for
//! tenths of metres; on plane ground there is no trend, and what looks like one is noise.

use crate::rover::PerAxle;
use crate::scalar::Scalar;

/// Travel after which a trend of which nothing new is told is down to a third, m: ground bends back.
const LENGTH: f64 = 0.1;
/// The share of an update's way that counts as the trend's is this, times the drift's variance over that of the angle: with a steady
/// gain α these are about as α is to one, and a trend is to be learned several times slower than what it is a trend of.
const LEARNED: f64 = 0.25;
/// No update counts for more than this share.
const MOST: f64 = 0.5;
/// Ground on which angles drift by this, over the nominal drift as a variance, is half way between plane and rough.
const ROUGH: f64 = 0.01;
/// A side that travels less than this in a frame stands, m.
const LEAST_TRAVEL: f64 = 1.0e-4;

/// The trends of a side's contact angles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Trends<S> {
    rad_per_m: PerAxle<S>,
    rough: S,
}

impl<S: Scalar> Trends<S> {
    /// None is known.
    pub fn new() -> Self {
        Self { rad_per_m: PerAxle::all(S::zero()), rough: S::zero() }
    }

    /// Forgets them: what the angles did last was not the ground's doing.
    pub fn forget(&mut self) {
        self.rad_per_m = PerAxle::all(S::zero());
    }

    /// Takes how fast the angles drift, over the nominal drift as a variance.
    pub fn on_ground_of(&mut self, factor: S) {
        self.rough = factor / (factor + S::constant(ROUGH));
    }

    /// How rough the ground is: 0 where it is plane, 1 where it is anything but.
    pub fn rough(&self) -> S {
        self.rough
    }

    /// By how much each angle turns along the way, rad/m.
    pub fn rad_per_m(&self) -> PerAxle<S> {
        self.rad_per_m.map(|trend| self.rough * trend)
    }

    /// Takes what an update has moved each angle by after so much travel, rad, the variance that each has now, and that of a step's
    /// drift, rad².
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn follow(&mut self, travel_m: S, moved: &PerAxle<(S, S)>, drift_variance: S) {
        if travel_m < S::constant(LEAST_TRAVEL) {
            return self.forget();
        }
        let kept = S::one() - (travel_m * S::constant(1.0 / LENGTH)).min(S::one());
        let learned = S::constant(LEARNED) * self.rough * drift_variance;
        let per_travel = S::one() / travel_m;
        for (trend, (moved, variance)) in self.rad_per_m.as_array_mut().into_iter().zip(moved.as_array()) {
            let share = if learned < S::constant(MOST) * *variance { learned / *variance } else { S::constant(MOST) };
            *trend = kept * *trend + share * per_travel * *moved;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Trends;
    use crate::rover::PerAxle;

    /// A filter of steady gain 0.1 that sees an angle turn by 1 rad over a metre, 2 mm at a time, without noise: alone it would lag
    /// by the way of nine steps; with its trend by a third of that at most. The damping keeps the trend from learning all.
    #[test]
    fn an_angle_that_turns_steadily_is_followed_more_closely() {
        let lag = |rough: f64| {
            let mut trends = Trends::<f64>::new();
            trends.on_ground_of(rough);
            let (travel, gain) = (0.002, 0.1);
            let (mut truth, mut angle) = (0.0, 0.0);
            for _ in 0..200 {
                truth += travel;
                angle += travel * trends.rad_per_m().front;
                let moved = gain * (truth - angle);
                angle += moved;
                trends.follow(travel, &PerAxle::all((moved, 1.0e-4)), 4.0 * gain * 1.0e-4);
            }
            truth - angle
        };
        assert!((lag(0.0) - 0.018).abs() < 1.0e-4, "{}", lag(0.0));
        assert!(lag(1.0) < 0.006, "{}", lag(1.0));
    }

    #[test]
    fn where_nothing_rolls_there_is_no_trend() {
        let mut trends = Trends::<f64>::new();
        trends.on_ground_of(1.0);
        trends.follow(0.002, &PerAxle::all((0.01, 1.0e-4)), 1.0e-4);
        assert!(trends.rad_per_m().rear > 0.1);
        trends.follow(0.0, &PerAxle::all((0.01, 1.0e-4)), 1.0e-4);
        assert_eq!(trends.rad_per_m(), PerAxle::all(0.0));
    }
}
