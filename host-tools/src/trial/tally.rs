//! Errors of one quantity against the truth, beside those of the raw sensors.

use kapvik_firmware::estimator::Estimate;

/// Errors of an estimate, how honest its standard deviation is, and what the raw sensors would have done.
#[derive(Debug, Clone, Copy, Default)]
pub struct Tally {
    sum: f64,
    squares: f64,
    within: [u64; 2],
    count: u64,
    naive: Squares,
    naive_mean: Squares,
}

#[derive(Debug, Clone, Copy, Default)]
struct Squares {
    sum: f64,
    count: u64,
}

impl Squares {
    fn take(&mut self, error: Option<f64>) {
        if let Some(error) = error {
            self.sum += error * error;
            self.count += 1;
        }
    }

    fn rmse(&self) -> f64 {
        (self.sum / self.count.max(1) as f64).sqrt()
    }
}

impl Tally {
    /// Takes an estimate, what one frame and the last second of the raw sensors say, and the truth.
    pub fn take(&mut self, estimate: Estimate, naive: Option<f64>, naive_mean: Option<f64>, truth: f64) {
        let (error, std) = (f64::from(estimate.value) - truth, f64::from(estimate.std));
        self.sum += error;
        self.squares += error * error;
        self.count += 1;
        for (within, stds) in self.within.iter_mut().zip([1.0, 2.0]) {
            *within += u64::from(error.abs() <= stds * std);
        }
        self.naive.take(naive.map(|value| value - truth));
        self.naive_mean.take(naive_mean.map(|value| value - truth));
    }

    /// Adds what another tally counted.
    pub fn add(&mut self, other: &Self) {
        self.sum += other.sum;
        self.squares += other.squares;
        self.count += other.count;
        self.within.iter_mut().zip(other.within).for_each(|(sum, part)| *sum += part);
        for (sum, part) in [(&mut self.naive, other.naive), (&mut self.naive_mean, other.naive_mean)] {
            sum.sum += part.sum;
            sum.count += part.count;
        }
    }

    /// How many estimates were counted.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Mean error.
    pub fn bias(&self) -> f64 {
        self.sum / self.count.max(1) as f64
    }

    /// Root mean square error.
    pub fn rmse(&self) -> f64 {
        (self.squares / self.count.max(1) as f64).sqrt()
    }

    /// Root mean square error of the raw sensors: frame by frame or as a mean of a second, whichever is better.
    pub fn naive_rmse(&self) -> f64 {
        self.naive.rmse().min(self.naive_mean.rmse())
    }

    /// Shares of the errors within one and within two stated standard deviations.
    pub fn coverage(&self) -> [f64; 2] {
        self.within.map(|within| within as f64 / self.count.max(1) as f64)
    }
}
