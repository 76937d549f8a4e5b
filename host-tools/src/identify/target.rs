//! An estimate with its intervals, and what these lack.

/// Standard deviations that a 68 % and a 95 % interval of an error reach.
const WIDTHS: [f64; 2] = [1.0, 1.96];
/// Share of the variance of what is believed beforehand that must be gone for a parameter to be told: as the library and the networks have it.
const TOLD: f64 = 0.5;

/// Whether a parameter that is known to a standard deviation is told by the data, that of what was believed beforehand being this.
pub fn is_told(std: f64, believed_std: f64) -> bool {
    std * std <= TOLD * believed_std * believed_std
}

/// An estimate of one number of a soil: of c, φ or K, or of a logarithm of one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// The estimate.
    pub value: f64,
    /// Its standard deviation.
    pub std: f64,
    /// The 68 % and the 95 % interval.
    pub intervals: [[f64; 2]; 2],
}

impl Target {
    /// The standard deviation of an error with which an interval would just hold a truth; zero where it does without.
    pub fn excess(&self, truth: f64, interval: usize) -> f64 {
        let error = truth - self.value;
        let [low, high] = self.intervals[interval];
        let reach = if error < 0.0 { self.value - low } else { high - self.value };
        (error * error - reach * reach).max(0.0).sqrt() / WIDTHS[interval]
    }

    /// Another value with the same intervals about it.
    pub fn at(&self, value: f64) -> Self {
        let moved = value - self.value;
        Self { value, std: self.std, intervals: self.intervals.map(|interval| interval.map(|end| end + moved)) }
    }

    /// With errors added to the intervals, within these ends; the standard deviation grows to at most this greatest one.
    pub fn widened(&self, errors: [f64; 2], ends: [f64; 2], greatest_std: f64) -> Self {
        let mut wide = *self;
        for ((interval, error), width) in wide.intervals.iter_mut().zip(errors).zip(WIDTHS) {
            if error > 0.0 {
                let side = |reach: f64| reach.hypot(width * error);
                let [low, high] = [side(self.value - interval[0]), side(interval[1] - self.value)];
                *interval = [(self.value - low).max(ends[0]), (self.value + high).min(ends[1])];
            }
        }
        wide.std = self.std.hypot(errors[0].max(errors[1])).min(greatest_std.max(self.std));
        wide
    }
}
