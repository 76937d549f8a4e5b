//! The Kalman filter of one number that drifts.

use crate::scalar::Scalar;

/// A number that drifts, measured as it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ScalarFilter<S> {
    /// Its mean.
    pub mean: S,
    /// Its variance.
    pub variance: S,
}

impl<S: Scalar> ScalarFilter<S> {
    /// Takes a measurement with noise of this variance, and gives its innovation's square over its variance, and that
    /// variance.
    pub fn update(&mut self, measured: S, noise_variance: S) -> (S, S) {
        let expected_variance = self.variance + noise_variance;
        let innovation = measured - self.mean;
        let gain = self.variance / expected_variance;
        self.mean += gain * innovation;
        self.variance = gain * noise_variance;
        (innovation * innovation / expected_variance, expected_variance)
    }
}
