//! Whether a filter's covariance is that of its errors: normalised squares against χ².

use nalgebra::{Cholesky, SMatrix, SVector};
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Wheels of a rover, and so places at which one frame may have a square of its own.
const PLACES: usize = 6;
/// A square of two or three degrees of freedom is as large once in a million times, where errors are normal and the covariance is right.
pub const WILD: f64 = 30.0;

/// Normalised squares over several runs, of errors (NEES) or of innovations (NIS), summed for each frame and each wheel or side by
/// itself: runs are independent of each other, wheels of one rover are not, since they share a camera and a body.
#[derive(Debug, Clone, Default)]
pub struct NormalisedSquares {
    cells: Vec<Sum>,
    wild: Sum,
}

/// A sum of squares and of their degrees of freedom.
#[derive(Debug, Clone, Copy, Default)]
pub struct Sum {
    /// Of the squares.
    pub squares: f64,
    /// Of the degrees of freedom.
    pub degrees: f64,
}

impl Sum {
    fn add(&mut self, other: &Self) {
        self.squares += other.squares;
        self.degrees += other.degrees;
    }
}

impl NormalisedSquares {
    /// Adds a square with its degrees of freedom at a frame, of the wheel or side at a place below six.
    pub fn add(&mut self, frame: usize, place: usize, squares: f64, degrees: f64) {
        let sum = Sum { squares, degrees };
        self.add_to_cell(frame * PLACES + place, &sum);
        if squares > WILD {
            self.wild.add(&sum);
        }
    }

    fn add_to_cell(&mut self, cell: usize, sum: &Sum) {
        if self.cells.len() <= cell {
            self.cells.resize(cell + 1, Sum::default());
        }
        if let Some(place) = self.cells.get_mut(cell) {
            place.add(sum);
        }
    }

    /// Adds those of another run, frame by frame and place by place.
    pub fn add_run(&mut self, other: &Self) {
        other.cells.iter().enumerate().for_each(|(cell, sum)| self.add_to_cell(cell, sum));
        self.wild.add(&other.wild);
    }

    fn filled(&self) -> impl Iterator<Item = &Sum> {
        self.cells.iter().filter(|cell| cell.degrees > 0.0)
    }

    /// Of all frames and places. Over its degrees of freedom, 1 where the covariance is right.
    pub fn total(&self) -> Sum {
        self.filled().fold(Sum::default(), |mut total, cell| {
            total.add(cell);
            total
        })
    }

    /// Shares that squares above [`WILD`], of two or three degrees of freedom each, have of their number and of their sum: one in a million
    /// and as good as nothing where errors are normal.
    pub fn wild(&self) -> (f64, f64) {
        let total = self.total();
        (self.wild.degrees / total.degrees, self.wild.squares / total.squares)
    }

    /// Share of the frames, place by place, whose mean over the runs lies inside its 95 % χ² bounds: 0.95 where the covariance is
    /// right in every run.
    pub fn share_inside(&self) -> f64 {
        let inside = |cell: &&Sum| {
            ChiSquared::new(cell.degrees).is_ok_and(|chi_squared| {
                cell.squares >= chi_squared.inverse_cdf(0.025) && cell.squares <= chi_squared.inverse_cdf(0.975)
            })
        };
        self.filled().filter(inside).count() as f64 / self.filled().count().max(1) as f64
    }
}

/// Square of an error in units of a covariance; none where that is singular.
pub fn normalised_square<const N: usize>(error: [f64; N], covariance: &[[f32; N]; N]) -> Option<f64> {
    let (scale, correlation) = correlation(covariance);
    let error = SVector::<f64, N>::from(error);
    let solved = Cholesky::new(correlation)?.solve(&error.component_div(&scale));
    Some(solved.dot(&error.component_div(&scale)))
}

/// Standard deviations and correlations of a covariance. Of different units it is better factorised as these.
pub fn correlation<const N: usize>(covariance: &[[f32; N]; N]) -> (SVector<f64, N>, SMatrix<f64, N, N>) {
    let covariance = SMatrix::<f64, N, N>::from_fn(|row, column| f64::from(covariance[row][column]));
    let scale = covariance.diagonal().map(f64::sqrt);
    (scale, covariance.component_div(&(scale * scale.transpose())))
}

#[cfg(test)]
mod tests {
    use super::NormalisedSquares;

    /// Six wheels that all err alike in each of forty runs: their squares say no more than those of one. Pooled they would leave the
    /// bounds of six times the degrees of freedom in most frames; each wheel by itself stays within its own in nineteen of twenty.
    #[test]
    fn wheels_that_share_an_error_are_judged_one_by_one() {
        use rand::SeedableRng;
        use rand_distr::{Distribution, StandardNormal};
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(5);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let (mut squares, mut pooled) = (NormalisedSquares::default(), NormalisedSquares::default());
        for frame in 0..400 {
            for _run in 0..40 {
                let square = normal().powi(2);
                (0..6).for_each(|wheel| squares.add(frame, wheel, square, 1.0));
                pooled.add(frame, 0, 6.0 * square, 6.0);
            }
        }
        // Four hundred frames: one standard error of the share is a hundredth.
        assert!((squares.share_inside() - 0.95).abs() < 0.035, "{}", squares.share_inside());
        assert!(pooled.share_inside() < 0.75, "{}", pooled.share_inside());
        assert!(squares.wild().0 < 1.0e-3);
    }
}
