//! Whether a filter's covariance is that of its errors: normalised squares against χ².

use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Normalised squares over several runs, frame by frame: of errors (NEES) or of innovations (NIS).
#[derive(Debug, Clone, Default)]
pub struct NormalisedSquares {
    frames: Vec<Frame>,
}

#[derive(Debug, Clone, Copy, Default)]
struct Frame {
    sum: f64,
    degrees: f64,
}

impl NormalisedSquares {
    /// Adds a square with its degrees of freedom at a frame.
    pub fn add(&mut self, frame: usize, square: f64, degrees: f64) {
        if self.frames.len() <= frame {
            self.frames.resize(frame + 1, Frame::default());
        }
        if let Some(place) = self.frames.get_mut(frame) {
            place.sum += square;
            place.degrees += degrees;
        }
    }

    /// Adds those of another run, frame by frame.
    pub fn add_run(&mut self, other: &Self) {
        for (frame, part) in other.frames.iter().enumerate() {
            self.add(frame, part.sum, part.degrees);
        }
    }

    fn filled(&self) -> impl Iterator<Item = &Frame> {
        self.frames.iter().filter(|frame| frame.degrees > 0.0)
    }

    /// Mean of the squares over their degrees of freedom: 1 where the covariance is right.
    pub fn mean(&self) -> f64 {
        let (sum, degrees) = self.filled().fold((0.0, 0.0), |(s, d), frame| (s + frame.sum, d + frame.degrees));
        sum / degrees
    }

    /// Share of the frames whose mean over the runs lies inside its 95 % χ² bounds: 0.95 where the covariance is right.
    pub fn share_inside(&self) -> f64 {
        let inside = |frame: &&Frame| {
            ChiSquared::new(frame.degrees).is_ok_and(|chi_squared| {
                frame.sum >= chi_squared.inverse_cdf(0.025) && frame.sum <= chi_squared.inverse_cdf(0.975)
            })
        };
        self.filled().filter(inside).count() as f64 / self.filled().count().max(1) as f64
    }
}

/// Square of an error in units of a covariance; none where that is singular.
pub fn normalised_square<const N: usize>(error: [f64; N], covariance: &[[f32; N]; N]) -> Option<f64> {
    let covariance = nalgebra::SMatrix::<f64, N, N>::from_fn(|row, column| f64::from(covariance[row][column]));
    let error = nalgebra::SVector::<f64, N>::from(error);
    // Of different units: scaled to a correlation first, so that the factorisation does not see them.
    let scale = covariance.diagonal().map(f64::sqrt);
    let correlation = covariance.component_div(&(scale * scale.transpose()));
    let solved = nalgebra::linalg::Cholesky::new(correlation)?.solve(&error.component_div(&scale));
    Some(solved.dot(&error.component_div(&scale)))
}
