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
