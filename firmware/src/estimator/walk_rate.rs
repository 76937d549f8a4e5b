//! How fast a quantity wanders, learned from what its sensor says.
//!
//! A random walk with one fixed rate is wrong on most ground: level sand changes nothing over metres, a rock changes
//! everything within a wheel radius. Several rates are tried side by side by filters of one number each, and each is
//! weighed by how likely it made the recent measurements (multiple-model estimation, Magill 1965).

use super::scalar_filter::ScalarFilter;
use crate::scalar::Scalar;

/// Rates that are tried, as variances over the nominal one: each sixteen times the one before; and the logarithm of that.
const CANDIDATES: usize = 5;
const LEAST: f64 = 1.0e-4;
const STEP: f64 = 16.0;
const LN_STEP: f64 = 2.772_588_722_239_781;

/// Of what the candidates explained badly, the share that is forgotten in a second: remembered over a tenth of a metre at two centimetres
/// a second. And the most that is forgotten in a frame, however long.
const FORGOTTEN: f64 = 0.2;
const MOST_FORGOTTEN: f64 = 0.5;
/// What smooth ground can hold against a faster rate, in twice the logarithm of likelihoods: the chance that the next frame is rough is
/// never below e⁻⁵. Ground gets rough from one frame to the next; that it has become smooth, only a length of it tells.
const HELD_AGAINST_FASTER: f64 = 10.0;
/// Of the way from the rate that was learned to the nominal one, what goes by in a second without a measurement.
const UNSEEN: f64 = 1.0;
/// The geometric mean of the candidates, the third of five: the rate of which nothing is known.
const UNKNOWN: f64 = LEAST * STEP * STEP;

/// The rate of one quantity.
#[derive(Debug, Clone, Copy)]
pub(super) struct WalkRate<S> {
    trials: [Trial<S>; CANDIDATES],
    last: S,
    factor: S,
    forgotten_per_s: S,
    frame: usize,
    /// Whether there was no measurement in the frame before.
    missed: bool,
}

/// Noise of a measurement, as variances.
#[derive(Debug, Clone, Copy)]
pub(super) struct Noise<S> {
    /// Of the measurement.
    pub variance: S,
    /// Of what the sensor itself has wandered by since the measurement before.
    pub moved: S,
}

impl<S: Scalar> Noise<S> {
    /// That of a sensor that stays what it is.
    pub fn white(std: S) -> Self {
        Self { variance: std * std, moved: S::zero() }
    }
}

#[derive(Debug, Clone, Copy)]
struct Trial<S> {
    /// Of the quantity less what was measured last: in a quantity itself single precision would round off what a slow candidate
    /// learns of it in a frame.
    filter: ScalarFilter<S>,
    /// ln of the innovation's variance over that of the first candidate, renewed now and then: it changes slowly. The logarithms
    /// themselves add up to hundreds, in which single precision would lose what tells the candidates apart.
    log_variance: S,
    /// Twice the negative logarithm of the likelihood of the recent measurements, up to what all candidates share.
    misfit: S,
}

impl<S: Scalar> WalkRate<S> {
    /// A rate of which nothing is known yet. Of many, each should have another `phase`: the costly part of the work is done
    /// in one of so many frames, and phases spread it.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn new(phase: usize) -> Self {
        let filter = ScalarFilter { mean: S::zero(), variance: S::constant(1.0e6) };
        let trial = Trial { filter, log_variance: S::zero(), misfit: S::zero() };
        Self {
            trials: [trial; CANDIDATES],
            last: S::zero(),
            factor: S::constant(UNKNOWN),
            forgotten_per_s: S::constant(FORGOTTEN),
            frame: phase,
            missed: false,
        }
    }

    /// The same with another memory: the share of a misfit that is no more held against a candidate a second later.
    pub fn forgetting(self, per_s: f64) -> Self {
        Self { forgotten_per_s: S::constant(per_s), ..self }
    }

    /// Takes a measurement, or that there is none, where the nominal walk in the step since the frame before has `nominal_variance`.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn take(&mut self, measured: Option<S>, noise: Noise<S>, nominal_variance: S, step_s: S) {
        match measured {
            Some(measured) => self.see(measured, noise, nominal_variance, step_s),
            None => self.miss(nominal_variance, step_s),
        }
    }

    /// The quantity has changed by so much, which is known, and no part of its wandering.
    pub fn carry(&mut self, by: S) {
        self.last += by;
    }

    fn see(&mut self, measured: S, noise: Noise<S>, nominal_variance: S, step_s: S) {
        self.frame = self.frame.wrapping_add(1);
        let renew = core::mem::take(&mut self.missed) || self.frame.is_multiple_of(CANDIDATES);
        let mut factor = S::constant(LEAST);
        let mut slower = S::constant(1.0e30);
        let mut first_log = None;
        let remembered = S::one() - (self.forgotten_per_s * step_s).min(S::constant(MOST_FORGOTTEN));
        let moved = measured - self.last;
        self.last = measured;
        for trial in &mut self.trials {
            trial.filter.variance += factor * nominal_variance + noise.moved;
            trial.filter.mean -= moved;
            let (misfit, variance) = trial.filter.update(S::zero(), noise.variance);
            if renew {
                let log = variance.ln();
                trial.log_variance = log - *first_log.get_or_insert(log);
            }
            // One wild measurement says that something is wrong with it, and little about the rate.
            let misfit = remembered * trial.misfit + misfit.min(S::constant(16.0)) + trial.log_variance;
            trial.misfit = misfit.min(slower + S::constant(HELD_AGAINST_FASTER));
            slower = slower.min(trial.misfit);
            factor = factor * S::constant(STEP);
        }
        if renew {
            self.factor = self.mean_factor();
        }
    }

    /// Lets the quantity wander unseen: the longer, the less tells that it wanders less than nominally.
    fn miss(&mut self, nominal_variance: S, step_s: S) {
        let mut factor = S::constant(LEAST);
        for trial in &mut self.trials {
            trial.filter.variance += factor * nominal_variance;
            factor = factor * S::constant(STEP);
        }
        let unseen = (S::constant(UNSEEN) * step_s).min(S::one());
        self.factor += unseen * (S::one() - self.factor).max(S::zero());
        self.missed = true;
    }

    /// The rate over the nominal one, as a variance.
    pub fn factor(&self) -> S {
        self.factor
    }

    /// Forgets what was explained so far, and where the quantity is: it jumped.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn restart(&mut self) {
        let (frame, forgotten_per_s) = (self.frame, self.forgotten_per_s);
        *self = Self { frame, forgotten_per_s, ..Self::new(0) };
    }

    /// The geometric mean of the candidates, weighed by their likelihood.
    fn mean_factor(&self) -> S {
        let best = self.trials.iter().fold(S::constant(1.0e30), |best, trial| best.min(trial.misfit));
        let (mut weights, mut sum, mut rank) = (S::zero(), S::zero(), S::zero());
        for trial in &self.trials {
            let weight = (S::constant(0.5) * (best - trial.misfit)).exp();
            weights += weight;
            sum += weight * rank;
            rank += S::one();
        }
        S::constant(LEAST) * (S::constant(LN_STEP) * (sum / weights)).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::{Noise, WalkRate};

    /// A noise-free staircase of a known rate, and a constant, both with alternating measurement errors.
    #[test]
    fn a_still_quantity_gets_a_lesser_rate_than_one_that_wanders() {
        let rate = |wander: f64| {
            let mut rate = WalkRate::<f64>::new(0);
            for frame in 0..200_u32 {
                let error = if frame.is_multiple_of(2) { 0.1 } else { -0.1 };
                let place = wander * f64::from(frame / 10 % 2);
                rate.take(Some(place + error), Noise::white(0.1), 0.01, 0.1);
            }
            rate.factor()
        };
        assert!(rate(0.0) < 1.0e-3, "{}", rate(0.0));
        assert!(rate(1.0) > 1.0, "{}", rate(1.0));
    }

    /// After a length of smooth ground in which every measurement is within its noise, one that begins to wander by several times its
    /// noise a frame is noticed within a few.
    #[test]
    fn smooth_ground_does_not_argue_for_long() {
        let mut rate = WalkRate::<f64>::new(0);
        let noise = |frame: u32| if frame.is_multiple_of(2) { 0.1 } else { -0.1 };
        (0..400).for_each(|frame| rate.take(Some(noise(frame)), Noise::white(0.1), 0.01, 0.1));
        assert!(rate.factor() < 1.0e-2, "{}", rate.factor());
        (0..10).for_each(|frame| rate.take(Some(0.3 * f64::from(frame) + noise(frame)), Noise::white(0.1), 0.01, 0.1));
        assert!(rate.factor() > 0.5, "{}", rate.factor());
    }
}
