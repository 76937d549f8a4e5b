//! How a wheel gains speed: beside the other wheels it then slips more, for the hubs of a rover go on as they went.

use crate::scalar::Scalar;

/// Over so long a rate and how it grows are looked at, s: over less, noise would be taken for a change.
const LOOK_S: f64 = 0.4;
/// A growth of so many standard deviations of its noise counts by half.
const DOUBTED: f64 = 2.2;
/// A rate below this tells no relative change, rad/s.
const LEAST_RATE: f64 = 0.02;
/// A wheel does not gain more than this share of its rate in a frame, but by an error.
const GREATEST: f64 = 0.1;
/// An encoder that says the same twice in a row in more than one of nine frames is coarse: by so much a repetition counts, to at most so much,
/// and from so much on it is. From frame to frame such a one tells where its steps lie, and not how the wheel gains speed.
const REPETITION: u8 = 8;
const MOST: u8 = 64;
const COARSE: u8 = 24;

/// The rate of a wheel and how it grows, by a fading memory of degree one (Morrison 1969), which does not lag behind a rate that grows
/// steadily; and the share of it that came on in the last frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct RimGrowth<S> {
    rate_rad_s: S,
    growth_rad_s2: S,
    share: S,
    /// How often the encoder said the same again, of late.
    repetitions: u8,
}

impl<S: Scalar> RimGrowth<S> {
    /// Of a wheel that stands.
    pub fn none() -> Self {
        Self { rate_rad_s: S::zero(), growth_rad_s2: S::zero(), share: S::zero(), repetitions: 0 }
    }

    /// The share that came on.
    pub fn share(&self) -> S {
        self.share
    }

    /// How fast the rate grows, rad/s².
    pub fn growth_rad_s2(&self) -> S {
        self.growth_rad_s2
    }

    /// Takes what the encoder says, rad/s, of one such standard deviation; nothing of a wheel that does not roll as it will; and whether it
    /// said the same again.
    pub fn follow(&mut self, step_s: S, measured: Option<S>, std_rad_s: S, repeats: bool) {
        self.repetitions = if repeats {
            self.repetitions.saturating_add(REPETITION).min(MOST)
        } else {
            self.repetitions.saturating_sub(1)
        };
        let rate_rad_s = measured.unwrap_or(S::zero());
        let least = rate_rad_s.abs().min(self.rate_rad_s.abs());
        if !(self.repetitions < COARSE && least > S::constant(LEAST_RATE) && step_s > S::zero()) {
            *self = Self { rate_rad_s, repetitions: self.repetitions, ..Self::none() };
            return;
        }
        let forgotten = step_s / (S::constant(LOOK_S) + step_s);
        let remembered = S::constant(2.0) - forgotten;
        let error = rate_rad_s - self.rate_rad_s - self.growth_rad_s2 * step_s;
        let gained = self.growth_rad_s2 * step_s + forgotten * remembered * error;
        self.rate_rad_s += gained;
        self.growth_rad_s2 += forgotten * forgotten * error / step_s;
        let square = |value: S| value * value;
        let spread = forgotten / remembered;
        let noise = S::constant(2.0 * DOUBTED * DOUBTED) * spread * square(spread * std_rad_s / step_s);
        let growth = square(self.growth_rad_s2);
        let share = gained / rate_rad_s * growth / (growth + noise).max(S::constant(1.0e-30));
        self.share = share.max(-S::constant(GREATEST)).min(S::constant(GREATEST));
    }
}

#[cfg(test)]
mod tests {
    use super::RimGrowth;

    fn sum(growth: &mut RimGrowth<f64>, rates: impl Iterator<Item = f64>) -> f64 {
        rates
            .map(|rate| {
                growth.follow(0.1, Some(rate), 1.0e-4, false);
                growth.share()
            })
            .sum()
    }

    #[test]
    fn the_shares_of_a_rate_that_grows_steadily_come_to_its_growth() {
        let mut growth = RimGrowth::none();
        growth.follow(0.1, Some(0.3), 1.0e-4, false);
        assert_eq!(growth.share(), 0.0, "it starts");
        let started = sum(&mut growth, (1..=40).map(|frame| 0.3 + 1.0e-3 * f64::from(frame)));
        let goes_on = sum(&mut growth, (41..=80).map(|frame| 0.3 + 1.0e-3 * f64::from(frame)));
        assert!((goes_on - (0.38_f64 / 0.34).ln()).abs() < 2.0e-3, "{goes_on}");
        assert!(started < (0.34_f64 / 0.3).ln() && started > 0.08, "{started}");
    }

    /// Steps of 0.01 rad/s in a rate that grows by a tenth of that in a frame.
    #[test]
    fn the_steps_of_a_coarse_encoder_are_no_growth() {
        let mut growth = RimGrowth::<f64>::none();
        let mut last = 0.0;
        let shares = (0..200_u32).map(|frame| {
            let rate = 0.3 + 0.01 * f64::from(frame / 10);
            growth.follow(0.1, Some(rate), 2.0e-3, rate == last);
            last = rate;
            growth.share().abs()
        });
        let largest = shares.skip(10).fold(0.0_f64, f64::max);
        assert_eq!(largest, 0.0);
    }

    #[test]
    fn noise_is_no_growth() {
        let mut growth = RimGrowth::<f64>::none();
        growth.follow(0.1, Some(0.3), 2.0e-3, false);
        let rates = (0..100).map(|frame| 0.3 + if frame % 3 == 0 { 2.0e-3 } else { -1.0e-3 });
        let largest = rates
            .map(|rate| {
                growth.follow(0.1, Some(rate), 2.0e-3, false);
                growth.share().abs()
            })
            .fold(0.0_f64, f64::max);
        assert!(largest < 1.0e-3, "{largest}");
    }
}
