//! How numbers scatter that come one after the other, none of which is kept (Welford 1962).

use nalgebra::{SMatrix, SVector};

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

/// The same of several numbers that come at once, with how they go together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunningTogether<const N: usize> {
    /// How many times.
    pub count: f64,
    /// The means; 0 of none.
    pub means: SVector<f64, N>,
    /// Products of how far each two are from their means, added.
    pub products: SMatrix<f64, N, N>,
}

impl<const N: usize> Default for RunningTogether<N> {
    fn default() -> Self {
        Self { count: 0.0, means: SVector::zeros(), products: SMatrix::zeros() }
    }
}

impl<const N: usize> RunningTogether<N> {
    /// Takes the numbers of one more time.
    pub fn take(&mut self, numbers: SVector<f64, N>) {
        self.count += 1.0;
        let before = numbers - self.means;
        self.means += before / self.count;
        self.products += before * (numbers - self.means).transpose();
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::{Running, RunningTogether};

    #[test]
    fn several_scatter_as_each_by_itself() {
        let (mut together, mut alone) = (RunningTogether::default(), Running::default());
        for number in [1.0, 2.0, 4.0, 5.0] {
            together.take(Vector2::new(number, -2.0 * number));
            alone.take(number);
        }
        assert_eq!((together.count, together.means), (alone.count, Vector2::new(alone.mean, -2.0 * alone.mean)));
        assert_eq!(together.products.as_slice(), [10.0, -20.0, -20.0, 40.0]);
    }

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
