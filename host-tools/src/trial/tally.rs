//! Errors of one quantity against the truth, beside those of the raw sensors.

use kapvik_firmware::estimator::Estimate;

/// Errors of an estimate, how honest its standard deviation is, and what the raw sensors would have done.
#[derive(Debug, Clone, Copy, Default)]
pub struct Tally {
    sum: f64,
    squares: f64,
    within: [u64; 2],
    count: u64,
    frame: Raw,
    second: Raw,
}

/// Squared errors of the raw sensors, and of the estimate in the frames where they said something.
#[derive(Debug, Clone, Copy, Default)]
struct Raw {
    squares: f64,
    of_estimate: f64,
    count: u64,
}

impl Raw {
    fn take(&mut self, error: Option<f64>, of_estimate: f64) {
        if let Some(error) = error {
            self.squares += error * error;
            self.of_estimate += of_estimate * of_estimate;
            self.count += 1;
        }
    }

    fn add(&mut self, other: &Self) {
        self.squares += other.squares;
        self.of_estimate += other.of_estimate;
        self.count += other.count;
    }

    /// No number where the sensors never said anything.
    fn mean_square(&self) -> f64 {
        self.squares / self.count as f64
    }
}

impl Tally {
    /// Takes an estimate, what one frame and the last second of the raw sensors say, and the truth.
    pub fn take(&mut self, estimate: Estimate, frame: Option<f64>, second: Option<f64>, truth: f64) {
        let (error, std) = (f64::from(estimate.value) - truth, f64::from(estimate.std));
        self.sum += error;
        self.squares += error * error;
        self.count += 1;
        for (within, stds) in self.within.iter_mut().zip([1.0, 2.0]) {
            *within += u64::from(error.abs() <= stds * std);
        }
        self.frame.take(frame.map(|value| value - truth), error);
        self.second.take(second.map(|value| value - truth), error);
    }

    /// Adds what another tally counted.
    pub fn add(&mut self, other: &Self) {
        self.sum += other.sum;
        self.squares += other.squares;
        self.count += other.count;
        self.within.iter_mut().zip(other.within).for_each(|(sum, part)| *sum += part);
        self.frame.add(&other.frame);
        self.second.add(&other.second);
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

    /// The raw sensors frame by frame or as a mean of a second, whichever is better.
    fn raw(&self) -> &Raw {
        if self.second.mean_square() < self.frame.mean_square() { &self.second } else { &self.frame }
    }

    /// Root mean square error of the raw sensors; no number where they never said anything.
    pub fn naive_rmse(&self) -> f64 {
        self.raw().mean_square().sqrt()
    }

    /// Root mean square error over that of the raw sensors, in the frames where these said something.
    pub fn over_naive(&self) -> f64 {
        (self.raw().of_estimate / self.raw().squares).sqrt()
    }

    /// Shares of the errors within one and within two stated standard deviations.
    pub fn coverage(&self) -> [f64; 2] {
        self.within.map(|within| within as f64 / self.count.max(1) as f64)
    }
}
