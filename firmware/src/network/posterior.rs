//! From a network's outputs to mean, standard deviation and intervals of ln c, φ and ln K.

use crate::math;

use super::shape::{OUTPUTS, TARGETS};
use super::words;

/// Knots of the interval factors.
pub const KNOTS: usize = 6;

/// How many standard deviations an interval reaches, by how much the data told.
///
/// A posterior that the data decide is near to normal (1 and 1.96); one that the prior decides has the prior's shape
/// (for a uniform one 1.18 and 1.65). The factors were measured on cases that took no part in training.
#[derive(Debug, Clone, PartialEq)]
pub struct IntervalFactors {
    /// Standard deviation over that of the prior, increasing.
    pub ratio: [f32; KNOTS],
    /// Half-width of the 68 % interval in standard deviations, at each ratio.
    pub factor_68: [f32; KNOTS],
    /// Half-width of the 95 % interval in standard deviations, at each ratio.
    pub factor_95: [f32; KNOTS],
}
words!(IntervalFactors: ratio, factor_68, factor_95);

impl IntervalFactors {
    /// All zero, for a table that is about to be filled.
    pub const ZERO: Self = Self { ratio: [0.0; KNOTS], factor_68: [0.0; KNOTS], factor_95: [0.0; KNOTS] };

    /// The factors of the 68 % and the 95 % interval at a ratio, linear between knots and constant beyond them.
    fn at(&self, ratio: f32) -> (f32, f32) {
        let knots = self.ratio.iter().zip(&self.factor_68).zip(&self.factor_95);
        let mut below: Option<(f32, f32, f32)> = None;
        for ((&knot, &f68), &f95) in knots {
            if ratio < knot {
                return match below {
                    Some((low, low_68, low_95)) => {
                        let part = (ratio - low) / (knot - low);
                        (low_68 + part * (f68 - low_68), low_95 + part * (f95 - low_95))
                    }
                    None => (f68, f95),
                };
            }
            below = Some((knot, f68, f95));
        }
        below.map_or((1.0, 1.0), |(_, f68, f95)| (f68, f95))
    }
}

/// The scale of the outputs and the prior that the network was trained with; three targets ln c, φ, ln K.
#[derive(Debug, Clone, PartialEq)]
pub struct PosteriorScale {
    /// Prior mean of each target.
    pub mean: [f32; TARGETS],
    /// Prior standard deviation of each target.
    pub std: [f32; TARGETS],
    /// Least value in the prior.
    pub low: [f32; TARGETS],
    /// Greatest value in the prior.
    pub high: [f32; TARGETS],
    /// Interval factors of each target.
    pub intervals: [IntervalFactors; TARGETS],
}
words!(PosteriorScale: mean, std, low, high, intervals);

/// Mean and spread of one target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Marginal {
    /// Posterior mean.
    pub mean: f32,
    /// Posterior standard deviation.
    pub std: f32,
    /// 68 % interval, inside the prior's range.
    pub interval_68: [f32; 2],
    /// 95 % interval, inside the prior's range.
    pub interval_95: [f32; 2],
    /// Whether the data removed at least half of the prior's variance.
    pub identifiable: bool,
}

/// The marginals of ln c, φ and ln K.
pub type Posterior = [Marginal; TARGETS];

impl PosteriorScale {
    /// All zero, for a table that is about to be filled.
    pub const ZERO: Self = Self {
        mean: [0.0; TARGETS],
        std: [0.0; TARGETS],
        low: [0.0; TARGETS],
        high: [0.0; TARGETS],
        intervals: [IntervalFactors::ZERO; TARGETS],
    };

    /// Reads outputs (means, then log-variances, both on the scale of the prior).
    pub fn read(&self, outputs: &[f32; OUTPUTS]) -> Posterior {
        let [m0, m1, m2, v0, v1, v2] = *outputs;
        let pairs = [(m0, v0), (m1, v1), (m2, v2)];
        let priors = self.mean.iter().zip(&self.std).zip(&self.low).zip(&self.high).zip(&self.intervals);
        let mut posterior = [Marginal::UNKNOWN; TARGETS];
        for ((place, (m, v)), ((((mean, std), low), high), intervals)) in posterior.iter_mut().zip(pairs).zip(priors) {
            // A network far outside its training range may promise anything; the prior bounds what is believed.
            let ratio = math::exp(0.5 * math::limit(v, -16.0, 0.0));
            let (factor_68, factor_95) = intervals.at(ratio);
            let centre = math::limit(mean + std * m, *low, *high);
            let spread = std * ratio;
            let interval =
                |factor: f32| [-factor * spread, factor * spread].map(|side| math::limit(centre + side, *low, *high));
            *place = Marginal {
                mean: centre,
                std: spread,
                interval_68: interval(factor_68),
                interval_95: interval(factor_95),
                identifiable: ratio * ratio <= 0.5,
            };
        }
        posterior
    }
}

impl Marginal {
    const UNKNOWN: Self =
        Self { mean: 0.0, std: 0.0, interval_68: [0.0; 2], interval_95: [0.0; 2], identifiable: false };
}
