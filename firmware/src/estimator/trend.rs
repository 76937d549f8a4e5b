//! How what is followed turns along the way: contact angles, forces on the cells, torques and slips.
//!
//! A filter that takes a quantity for a random walk lags behind one that goes steadily one way, by the way over which it averages.
//! What its updates move the quantity by, time after time the same way, tells the trend; the next frame is expected that much
//! further on (exponential smoothing with a damped trend, Holt 1957; Gardner and McKenzie 1985). Ground of hills and rocks bends
//! one way for tenths of metres; on plane ground there is no trend, and what looks like one is noise.

use crate::scalar::Scalar;

/// Travel after which a trend of which nothing new is told is down to a third, m: ground bends back.
const LENGTH: f64 = 0.1;
/// No update counts for more than this share as the trend's.
const MOST: f64 = 0.5;
/// A quantity that drifts by this, over its nominal drift as a variance, is half way between still and restless.
const RESTLESS: f64 = 0.01;
/// A side that travels less than this in a frame stands, m.
pub(super) const LEAST_TRAVEL: f64 = 1.0e-4;

/// How restless a quantity is that drifts by such a factor of its nominal drift, as a variance: 0 where it is still, 1 where it is
/// anything but.
pub(super) fn restlessness<S: Scalar>(factor: S) -> S {
    factor / (factor + S::constant(RESTLESS))
}

/// What is left of a drift, as a variance, beside a trend that is followed: all of it where the quantity is still, `left` where it is
/// as restless as can be.
pub(super) fn beside_trend<S: Scalar>(left: f64, restless: S) -> S {
    S::one() - S::constant(1.0 - left) * restless
}

/// The trends of `N` quantities.
#[derive(Debug, Clone, Copy)]
pub(super) struct Trends<S, const N: usize> {
    per_m: [S; N],
    restless: [S; N],
    /// Travel since each quantity was told of last, m; infinite where it was not since the trends were forgotten.
    untold_m: [S; N],
}

impl<S: Scalar, const N: usize> Trends<S, N> {
    /// None is known.
    pub fn new() -> Self {
        Self { per_m: [S::zero(); N], restless: [S::zero(); N], untold_m: [S::constant(f64::INFINITY); N] }
    }

    /// Forgets them: what was seen last was not the ground's doing. Nor is what the next update makes good.
    pub fn forget(&mut self) {
        self.per_m = [S::zero(); N];
        self.untold_m = [S::constant(f64::INFINITY); N];
    }

    /// Takes how restless each quantity is.
    pub fn expect(&mut self, restless: [S; N]) {
        self.restless = restless;
    }

    /// How restless each quantity is: 0 … 1.
    pub fn restless(&self) -> [S; N] {
        self.restless
    }

    /// By how much each quantity is expected to go on, its unit per metre.
    pub fn per_m(&self) -> [S; N] {
        let mut expected = self.per_m;
        expected.iter_mut().zip(self.restless).for_each(|(trend, restless)| *trend = *trend * restless);
        expected
    }

    /// Takes what an update has moved each quantity by after so much travel, and the share of it that counts as the trend's; `told` of
    /// those that something was measured of. With a steady gain α, that share is best a quarter of α or so: a trend is to be learned
    /// several times slower than what it is a trend of. What a measurement makes good after others were missing happened since the last
    /// one.
    pub fn follow(&mut self, travel_m: S, moved: &[(S, S); N], told: [bool; N]) {
        if travel_m < S::constant(LEAST_TRAVEL) {
            return self.forget();
        }
        let kept = S::one() - (travel_m * S::constant(1.0 / LENGTH)).min(S::one());
        let quantities = self.per_m.iter_mut().zip(self.untold_m.iter_mut().zip(told));
        for ((trend, (untold_m, told)), (restless, (moved, share))) in quantities.zip(self.restless.iter().zip(moved)) {
            *trend = kept * *trend;
            *untold_m += travel_m;
            if told {
                *trend += (*restless * *share).min(S::constant(MOST)) / *untold_m * *moved;
                *untold_m = S::zero();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Trends, restlessness};

    /// A filter of steady gain 0.1 that sees an angle turn by 1 rad over a metre, 2 mm at a time, without noise: alone it would lag
    /// by the way of nine steps; with its trend by a third of that at most. The damping keeps the trend from learning all.
    #[test]
    fn what_turns_steadily_is_followed_more_closely() {
        let lag = |factor: f64| {
            let mut trends = Trends::<f64, 1>::new();
            trends.expect([restlessness(factor)]);
            let (travel, gain) = (0.002, 0.1);
            let (mut truth, mut angle) = (0.0, 0.0);
            for _ in 0..200 {
                truth += travel;
                let [expected] = trends.per_m();
                angle += travel * expected;
                let moved = gain * (truth - angle);
                angle += moved;
                trends.follow(travel, &[(moved, gain)], [true]);
            }
            truth - angle
        };
        assert!((lag(0.0) - 0.018).abs() < 1.0e-4, "{}", lag(0.0));
        assert!(lag(1.0) < 0.006, "{}", lag(1.0));
    }

    #[test]
    fn where_nothing_rolls_there_is_no_trend() {
        let mut trends = Trends::<f64, 1>::new();
        trends.expect([1.0]);
        (0..2).for_each(|_| trends.follow(0.002, &[(0.01, 0.1)], [true]));
        assert!(trends.per_m() > [0.1]);
        trends.follow(0.0, &[(0.01, 0.1)], [true]);
        assert_eq!(trends.per_m(), [0.0]);
    }

    /// A filter that has let go of what it believed comes back to it in one update: the ground has not turned by that.
    #[test]
    fn what_is_made_good_after_forgetting_is_no_trend() {
        let mut trends = Trends::<f64, 1>::new();
        trends.expect([1.0]);
        (0..20).for_each(|_| trends.follow(0.002, &[(0.01, 0.1)], [true]));
        trends.forget();
        trends.follow(0.002, &[(70.0, 0.5)], [true]);
        assert_eq!(trends.per_m(), [0.0]);
        trends.follow(0.002, &[(0.01, 0.1)], [true]);
        assert!(trends.per_m() > [0.1]);
    }

    /// What one measurement of five makes good is the way of five frames.
    #[test]
    fn what_is_told_late_is_no_steeper() {
        let mut trends = Trends::<f64, 2>::new();
        trends.expect([1.0; 2]);
        trends.follow(0.002, &[(0.0, 0.1); 2], [true; 2]);
        trends.follow(0.002, &[(0.01, 0.1), (0.0, 0.1)], [true, false]);
        (0..3).for_each(|_| trends.follow(0.002, &[(0.0, 0.1); 2], [false; 2]));
        trends.follow(0.002, &[(0.0, 0.1), (0.05, 0.1)], [false, true]);
        let [at_once, late] = trends.per_m();
        assert!((late - 0.5).abs() < 1.0e-12 && at_once < 0.5, "{late} {at_once}");
    }
}
