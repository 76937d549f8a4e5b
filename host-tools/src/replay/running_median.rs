//! The median of any number of sizes in a fixed place.

/// How often a size was in which of its bins, each greater than the one before by the same share.
#[derive(Debug, Clone)]
pub(super) struct RunningMedian {
    least: f64,
    growth: f64,
    counts: Vec<u32>,
    count: u32,
}

impl RunningMedian {
    /// Of none yet: `bins` of them, from the least size on, below which all are alike, as those beyond the last bin are.
    pub fn of_none(least: f64, growth: f64, bins: usize) -> Self {
        Self { least, growth, counts: vec![0; bins], count: 0 }
    }

    /// Takes a size; nothing is done with one that is none.
    pub fn take(&mut self, size: f64) {
        if !(size.is_finite() && size >= 0.0) {
            return;
        }
        let last = (self.counts.len() - 1) as f64;
        let bin = libm::log(size / self.least) / libm::log(self.growth);
        self.counts[bin.clamp(0.0, last) as usize] += 1;
        self.count += 1;
    }

    /// The size from which none is told from a greater one.
    pub fn farthest(&self) -> f64 {
        self.least * libm::pow(self.growth, (self.counts.len() - 1) as f64)
    }

    /// How many were taken.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// The middle of the bin in which the median is; none where none were taken.
    pub fn median(&self) -> Option<f64> {
        let mut below = 0;
        let bin = self.counts.iter().position(|count| {
            below += count;
            2 * below > self.count
        });
        Some(self.least * libm::pow(self.growth, bin? as f64 + 0.5))
    }
}

#[cfg(test)]
mod tests {
    use super::RunningMedian;

    #[test]
    fn the_median_is_known_to_a_bin() {
        let mut sizes = RunningMedian::of_none(0.01, 1.02, 700);
        assert_eq!(sizes.median(), None);
        (1..=101).for_each(|size| sizes.take(f64::from(size)));
        [f64::NAN, f64::INFINITY, -1.0].into_iter().for_each(|size| sizes.take(size));
        assert_eq!(sizes.count(), 101);
        assert!(sizes.median().is_some_and(|median| (median / 51.0 - 1.0).abs() < 0.02), "{:?}", sizes.median());
        (0..3).for_each(|_| sizes.take(0.0));
        (0..99).for_each(|_| sizes.take(1e9));
        assert!(sizes.median().is_some_and(|median| median < 102.0), "of more than half: {:?}", sizes.median());
    }
}
