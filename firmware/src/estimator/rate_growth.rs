//! How fast the rate of a wheel grows.

use crate::scalar::Scalar;

/// Over so long a rate and how it grows are looked at, s: over less, noise would be taken for a change.
const LOOK_S: f64 = 0.4;

/// A rate and how it grows, by a fading memory of degree one (Morrison 1969), which does not lag behind a rate that grows steadily.
#[derive(Debug, Clone, Copy)]
pub(super) struct RateGrowth<S> {
    rate_rad_s: S,
    growth_rad_s2: S,
}

impl<S: Scalar> RateGrowth<S> {
    /// Of a wheel that stands.
    pub fn none() -> Self {
        Self { rate_rad_s: S::zero(), growth_rad_s2: S::zero() }
    }

    /// How fast the rate grows, rad/s².
    pub fn rad_s2(&self) -> S {
        self.growth_rad_s2
    }

    /// Takes the rate so long, s, after the one before, rad/s.
    pub fn follow(&mut self, step_s: S, rate_rad_s: S) {
        let look_s = S::constant(LOOK_S);
        let forgotten = step_s / (look_s + step_s);
        let error = rate_rad_s - self.rate_rad_s - self.growth_rad_s2 * step_s;
        self.rate_rad_s = rate_rad_s - (S::one() - forgotten) * (S::one() - forgotten) * error;
        self.growth_rad_s2 += forgotten / (look_s + step_s) * error;
    }
}

#[cfg(test)]
mod tests {
    use super::RateGrowth;

    #[test]
    fn a_steady_growth_is_told_without_a_lag() {
        let mut growth = RateGrowth::<f64>::none();
        (0..100).for_each(|frame| growth.follow(0.1, 0.3 + 0.02 * f64::from(frame)));
        assert!((growth.rad_s2() - 0.2).abs() < 1.0e-3, "{}", growth.rad_s2());
        (0..100).for_each(|_| growth.follow(0.1, 2.3));
        assert!(growth.rad_s2().abs() < 1.0e-3, "{}", growth.rad_s2());
        growth.follow(0.0, 2.3);
        assert!(growth.rad_s2().is_finite());
    }
}
