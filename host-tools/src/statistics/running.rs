//! How numbers scatter that come one after the other, none of which is kept (Welford 1962).

/// How many numbers there were, their mean, and how far they are from it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Running {
    /// How many.
    pub count: f64,
    /// Their mean; 0 of none.
    pub mean: f64,
    /// Squares of how far each is from it, added.
    pub squares: f64,
}

impl Running {
    /// Takes one more.
    pub fn take(&mut self, number: f64) {
        self.count += 1.0;
        let before = number - self.mean;
        self.mean += before / self.count;
        self.squares += before * (number - self.mean);
    }

    /// Standard error of the mean; not a number of fewer than two.
    pub fn standard_error(&self) -> f64 {
        (self.squares / (self.count - 1.0) / self.count).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::Running;

    #[test]
    fn far_from_zero_they_scatter_as_near_it() {
        let mut running = Running::default();
        for number in [1.0, 2.0, 4.0, 5.0] {
            running.take(1e9 + number);
        }
        assert_eq!((running.count, running.mean), (4.0, 1e9 + 3.0));
        assert!((running.squares - 10.0).abs() < 1e-5, "{running:?}");
        assert!((running.standard_error() - (10.0_f64 / 12.0).sqrt()).abs() < 1e-6);
        assert!(Running::default().standard_error().is_nan());
    }
}
