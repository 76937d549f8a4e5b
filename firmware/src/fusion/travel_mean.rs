//! Means over travel.

/// A mean that forgets with travel: of equal weights until its length is full, then exponential.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TravelMean {
    length_m: f32,
    travel_m: f32,
    mean: f32,
}

impl TravelMean {
    /// An empty mean over a length, m.
    pub const fn new(length_m: f32) -> Self {
        Self { length_m, travel_m: 0.0, mean: 0.0 }
    }

    /// Takes a value that held over some travel, m.
    pub fn take(&mut self, value: f32, travel_m: f32) {
        self.travel_m += travel_m;
        let whole = if self.travel_m < self.length_m { self.travel_m } else { self.length_m };
        if travel_m > 0.0 {
            let share = travel_m / whole;
            self.mean += if share < 1.0 { share * (value - self.mean) } else { value - self.mean };
        }
    }

    /// The mean.
    pub fn mean(&self) -> f32 {
        self.mean
    }

    /// Travel since it was empty, m.
    pub fn travel_m(&self) -> f32 {
        self.travel_m
    }

    /// The same value, over another length, as if it had just been learned.
    pub fn restarted_as(&self, recent: &Self) -> Self {
        Self { length_m: self.length_m, travel_m: recent.length_m, mean: recent.mean }
    }
}

/// Means of values that are weighed alike, which forget with travel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WeightedTravelMeans<const VALUES: usize> {
    length_m: f32,
    weight_m: f32,
    means: [f32; VALUES],
}

impl<const VALUES: usize> WeightedTravelMeans<VALUES> {
    /// Empty means over a length, m.
    pub const fn new(length_m: f32) -> Self {
        Self { length_m, weight_m: 0.0, means: [0.0; VALUES] }
    }

    /// Takes values of some weight (> 0) that held over some travel, m.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn take(&mut self, values: &[f32; VALUES], weight: f32, travel_m: f32) {
        let forgotten = travel_m / self.length_m;
        let kept = if forgotten < 1.0 { 1.0 - forgotten } else { 0.0 };
        let added = weight * travel_m;
        self.weight_m = kept * self.weight_m + added;
        if added > 0.0 {
            let share = added / self.weight_m;
            self.means.iter_mut().zip(values).for_each(|(mean, value)| *mean += share * (value - *mean));
        }
    }

    /// The means.
    pub fn means(&self) -> &[f32; VALUES] {
        &self.means
    }

    /// Whether they have taken nothing yet.
    pub fn is_empty(&self) -> bool {
        self.weight_m <= 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::{TravelMean, WeightedTravelMeans};

    #[test]
    fn a_mean_weighs_equally_until_its_length_is_full_and_forgets_then() {
        let mut mean = TravelMean::new(1.0);
        (0..10).for_each(|step| mean.take(if step < 5 { 0.0 } else { 2.0 }, 0.1));
        assert!((mean.mean() - 1.0).abs() < 1.0e-6);
        (0..100).for_each(|_| mean.take(2.0, 0.1));
        assert!((mean.mean() - 2.0).abs() < 1.0e-3);
    }

    #[test]
    fn what_weighs_little_changes_little() {
        let mut means = WeightedTravelMeans::new(1.0e6);
        assert!(means.is_empty());
        means.take(&[1.0, 3.0], 100.0, 0.5);
        means.take(&[0.0, 3.0], 1.0, 0.5);
        let [changing, steady] = *means.means();
        assert!((changing - 100.0 / 101.0).abs() < 1.0e-5);
        assert!((steady - 3.0).abs() < 1.0e-5);
    }
}
