//! What data say of a standard deviation.

use std::ops::{Add, Sub};

use super::observation::CHANNELS;

/// Largest factor on a variance in one round.
const LARGEST_CHANGE: f64 = 10.0;
/// Power of the ratio by which a variance changes, at most: fast where the data hardly inform it.
const LARGEST_POWER: f64 = 5.0;

/// Squares in units of a variance, the degrees of freedom that the data leave it, and how many deviations it describes.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub(super) struct Share {
    pub squares: f64,
    pub freedom: f64,
    pub count: f64,
}

impl Share {
    /// Slope of the log-likelihood along the logarithm of the variance.
    pub(super) fn slope(&self) -> f64 {
        0.5 * (self.squares - self.freedom)
    }

    /// Factor on the variance: a Newton step along its logarithm, as the ratio of squares to freedom falls like the power
    /// freedom / count of it.
    pub(super) fn factor(&self) -> f64 {
        if self.freedom <= 0.0 || self.count <= 0.0 {
            return 1.0;
        }
        let power = (self.count / self.freedom).clamp(1.0, LARGEST_POWER);
        (self.squares / self.freedom).powf(power).clamp(1.0 / LARGEST_CHANGE, LARGEST_CHANGE)
    }
}

/// Shares of the offsets and of the noise, by channel.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub(super) struct VarianceShares {
    pub offset: [Share; CHANNELS],
    pub noise: [Share; CHANNELS],
}

impl Add for Share {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            squares: self.squares + other.squares,
            freedom: self.freedom + other.freedom,
            count: self.count + other.count,
        }
    }
}

impl Sub for Share {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self {
            squares: self.squares - other.squares,
            freedom: self.freedom - other.freedom,
            count: self.count - other.count,
        }
    }
}

impl Add for VarianceShares {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            offset: std::array::from_fn(|c| self.offset[c] + other.offset[c]),
            noise: std::array::from_fn(|c| self.noise[c] + other.noise[c]),
        }
    }
}

impl Sub for VarianceShares {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self {
            offset: std::array::from_fn(|c| self.offset[c] - other.offset[c]),
            noise: std::array::from_fn(|c| self.noise[c] - other.noise[c]),
        }
    }
}
