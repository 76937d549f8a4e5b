//! Draws of numbers: everything about a drawn campaign follows from the seed of one stream.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::prior::Range;

/// A stream of random numbers that belongs to one campaign.
#[derive(Debug, Clone)]
pub struct Chance(ChaCha8Rng);

impl Chance {
    /// The stream of a campaign: the same for the same seed, kind of campaign and number within the kind.
    pub fn new(seed: u64, kind: &str, number: u64) -> Self {
        // FNV-1a over the name: kinds have streams of their own, so that one more of a kind changes no other.
        let name = kind
            .bytes()
            .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3));
        let mut key = [0_u8; 32];
        for (part, value) in key.chunks_mut(8).zip([seed, name, number, 0]) {
            part.copy_from_slice(&value.to_le_bytes());
        }
        Self(ChaCha8Rng::from_seed(key))
    }

    /// Uniform in `low … high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.random::<f64>()
    }

    /// Uniform in the logarithm, `low … high`, both above zero.
    pub fn log_between(&mut self, low: f64, high: f64) -> f64 {
        libm::exp(self.between(libm::log(low), libm::log(high)))
    }

    /// From one of the stated ranges.
    pub fn of(&mut self, range: Range) -> f64 {
        range.at(self.0.random::<f64>())
    }

    /// True with the given probability.
    pub fn happens(&mut self, probability: f64) -> bool {
        self.0.random::<f64>() < probability
    }

    /// A whole number in `low ..= high`, uniform in the logarithm.
    pub fn count(&mut self, low: usize, high: usize) -> usize {
        let drawn = self.log_between(low as f64, high as f64 + 1.0);
        (drawn as usize).clamp(low, high)
    }

    /// One of several, all alike; `options` must not be empty.
    pub fn pick<T: Copy>(&mut self, options: &[T]) -> T {
        options[self.0.random_range(0..options.len())]
    }

    /// Normal with mean 0 and the given standard deviation.
    pub fn normal(&mut self, std: f64) -> f64 {
        let standard: f64 = StandardNormal.sample(&mut self.0);
        std * standard
    }

    /// +1 or −1.
    pub fn sign(&mut self) -> f64 {
        if self.happens(0.5) { 1.0 } else { -1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_repeat_and_differ() {
        let first = |seed, kind, number| Chance::new(seed, kind, number).between(0.0, 1.0);
        assert_eq!(first(1, "rate", 0), first(1, "rate", 0));
        assert_ne!(first(1, "rate", 0), first(1, "rate", 1));
        assert_ne!(first(1, "rate", 0), first(1, "clean", 0));
        assert_ne!(first(1, "rate", 0), first(2, "rate", 0));
    }

    #[test]
    fn counts_keep_their_ends() {
        let mut chance = Chance::new(3, "counts", 0);
        let counts: Vec<usize> = (0..2000).map(|_| chance.count(1, 4)).collect();
        assert!((1..=4).all(|wanted| counts.contains(&wanted)));
        assert!(counts.iter().all(|count| (1..=4).contains(count)));
    }
}
