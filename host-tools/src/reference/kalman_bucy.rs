//! The continuous-time unscented Kalman–Bucy filter.
//!
//! Source: Särkkä, "On unscented Kalman filtering for state estimation of continuous-time nonlinear systems", IEEE
//! Transactions on Automatic Control 52 (2007) 1631–1641. Mean m and covariance P follow
//!
//! ṁ = f̄ + K (y − h̄), Ṗ = Cov(x, f) + Cov(f, x) + Q − K R Kᵀ, K = Cov(x, h) R⁻¹,
//!
//! with the expectations over sigma points of the present m and P. Q and R are spectral densities. The weights are those
//! of α = 1, β = 2, κ = 0. A measurement is held for the span in which it counts.

use nalgebra::{Cholesky, SMatrix, SVector};
use thiserror::Error;

use super::continuous_model::ContinuousModel;

/// A step is at most so much over the rate at which the measurements draw the estimate to themselves. The covariance closes
/// in twice as fast, and the fourth-order Runge–Kutta method is stable up to 2.78 over a rate.
const STEP_OVER_RATE: f64 = 0.5;
/// A step that leaves the positive definite matrices is halved at most so often.
const HALVINGS: usize = 40;

/// The state's covariance is no longer positive definite, however short the step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("the covariance is not positive definite")]
pub struct NotPositiveDefinite;

/// What drives the filter for a while.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drive<const N: usize, const M: usize> {
    /// Spectral density of the process noise of each state, its unit squared per second.
    pub process_density: [f64; N],
    /// What is measured.
    pub measured: [f64; M],
    /// Spectral density of each measurement's noise, its unit squared times seconds.
    pub noise_density: [f64; M],
}

/// The filter of a state of `N` numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KalmanBucyFilter<const N: usize> {
    mean: SVector<f64, N>,
    covariance: SMatrix<f64, N, N>,
    steps: u64,
}

/// How mean and covariance change, per second, and how fast the measurements draw them.
struct Flow<const N: usize> {
    mean: SVector<f64, N>,
    covariance: SMatrix<f64, N, N>,
    rate: f64,
}

impl<const N: usize> KalmanBucyFilter<N> {
    /// A filter that starts from independent numbers.
    pub fn new(mean: [f64; N], std: [f64; N]) -> Self {
        let variances = SVector::from(std.map(|std| std * std));
        Self { mean: SVector::from(mean), covariance: SMatrix::from_diagonal(&variances), steps: 0 }
    }

    /// The mean.
    pub fn mean(&self) -> [f64; N] {
        self.mean.into()
    }

    /// The standard deviation of each number.
    pub fn stds(&self) -> [f64; N] {
        self.covariance.diagonal().map(f64::sqrt).into()
    }

    /// How many steps were taken.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Carries the estimate on over a span of time, in as many steps as its stiffness asks for.
    ///
    /// # Errors
    /// Where the covariance does not stay positive definite.
    pub fn advance<const M: usize>(
        &mut self,
        span_s: f64,
        model: &impl ContinuousModel<N, M>,
        drive: &Drive<N, M>,
    ) -> Result<(), NotPositiveDefinite> {
        let mut left_s = span_s;
        while left_s > 0.0 {
            let rate = flow(&self.mean, &self.covariance, model, drive).ok_or(NotPositiveDefinite)?.rate;
            let mut step_s = left_s.min(STEP_OVER_RATE / rate);
            let mut next = self.stepped(step_s, model, drive);
            for _ in 0..HALVINGS {
                if next.is_some() {
                    break;
                }
                step_s *= 0.5;
                next = self.stepped(step_s, model, drive);
            }
            (self.mean, self.covariance) = next.ok_or(NotPositiveDefinite)?;
            self.steps += 1;
            left_s -= step_s;
        }
        Ok(())
    }

    /// A step of the classical Runge–Kutta method; none where it leaves the positive definite matrices.
    fn stepped<const M: usize>(
        &self,
        step_s: f64,
        model: &impl ContinuousModel<N, M>,
        drive: &Drive<N, M>,
    ) -> Option<(SVector<f64, N>, SMatrix<f64, N, N>)> {
        let at =
            |flow: &Flow<N>, step_s: f64| (self.mean + flow.mean * step_s, self.covariance + flow.covariance * step_s);
        let flow_at = |(mean, covariance)| flow(&mean, &covariance, model, drive);
        let first = flow_at((self.mean, self.covariance))?;
        let second = flow_at(at(&first, 0.5 * step_s))?;
        let third = flow_at(at(&second, 0.5 * step_s))?;
        let fourth = flow_at(at(&third, step_s))?;
        let mean = (first.mean + (second.mean + third.mean) * 2.0 + fourth.mean) / 6.0;
        let covariance = (first.covariance + (second.covariance + third.covariance) * 2.0 + fourth.covariance) / 6.0;
        let (mean, covariance) = (self.mean + mean * step_s, self.covariance + covariance * step_s);
        Cholesky::new(covariance).map(|_| (mean, (covariance + covariance.transpose()) * 0.5))
    }
}

/// The right-hand sides of the filter's equations.
fn flow<const N: usize, const M: usize>(
    mean: &SVector<f64, N>,
    covariance: &SMatrix<f64, N, N>,
    model: &impl ContinuousModel<N, M>,
    drive: &Drive<N, M>,
) -> Option<Flow<N>> {
    let root = Cholesky::new(*covariance)?.unpack();
    let reach = (N as f64).sqrt();
    let (mut mean_rates, mut expected) = (SVector::<f64, N>::zeros(), SVector::<f64, M>::zeros());
    // Row i: half the difference across the two points along column i of the root, over the reach.
    let (mut rate_slopes, mut slopes) = (SMatrix::<f64, N, N>::zeros(), SMatrix::<f64, N, M>::zeros());
    for (index, column) in root.column_iter().enumerate() {
        let point = |sign: f64| {
            let state: [f64; N] = (mean + column * (sign * reach)).into();
            (SVector::from(model.rates(&state)), SVector::from(model.measure(&state)))
        };
        let ((rates_ahead, ahead), (rates_behind, behind)) = (point(1.0), point(-1.0));
        mean_rates += (rates_ahead + rates_behind) / (2.0 * N as f64);
        expected += (ahead + behind) / (2.0 * N as f64);
        rate_slopes.set_row(index, &((rates_ahead - rates_behind) / (2.0 * reach)).transpose());
        slopes.set_row(index, &((ahead - behind) / (2.0 * reach)).transpose());
    }
    let information = SVector::from(drive.noise_density).map(f64::recip);
    let gain = root * slopes * SMatrix::from_diagonal(&information);
    let by_rates = root * rate_slopes;
    let innovation = SVector::from(drive.measured) - expected;
    Some(Flow {
        mean: mean_rates + gain * innovation,
        covariance: by_rates + by_rates.transpose() + SMatrix::from_diagonal(&SVector::from(drive.process_density))
            - gain * (root * slopes).transpose(),
        rate: (slopes.component_mul(&slopes) * information).sum(),
    })
}

#[cfg(test)]
mod tests {
    use super::{Drive, KalmanBucyFilter};
    use crate::reference::continuous_model::ContinuousModel;

    /// One number that decays or grows, measured as it is.
    struct Scalar {
        rate: f64,
    }

    impl ContinuousModel<1, 1> for Scalar {
        fn rates(&self, [state]: &[f64; 1]) -> [f64; 1] {
            [self.rate * state]
        }
        fn measure(&self, state: &[f64; 1]) -> [f64; 1] {
            *state
        }
    }

    /// The Riccati equation Ṗ = 2 a P + q − P²/r has a closed solution: with s = √(a² + q/r) and the fixed points
    /// r (a ± s), (P − P₊)/(P − P₋) decays as e^(−2 s t).
    #[test]
    fn the_covariance_follows_the_closed_solution_of_the_riccati_equation() {
        for (rate, process, noise, start) in [(0.0, 0.3, 0.01, 1.0), (-0.5, 2.0, 0.1, 25.0), (0.7, 0.1, 1.0e-6, 100.0)]
        {
            let drive = Drive { process_density: [process], measured: [0.0], noise_density: [noise] };
            let mut filter = KalmanBucyFilter::new([1.0], [f64::sqrt(start)]);
            let speed = f64::sqrt(rate * rate + process / noise);
            let (upper, lower) = (noise * (rate + speed), noise * (rate - speed));
            let ratio = (start - upper) / (start - lower);
            let span_s = 0.1 / speed;
            for step in 1..=30 {
                filter.advance(span_s, &Scalar { rate }, &drive).expect("positive definite");
                let ratio = ratio * f64::exp(-2.0 * speed * span_s * f64::from(step));
                let expected = (upper - lower * ratio) / (1.0 - ratio);
                let [std] = filter.stds();
                assert!((std * std / expected - 1.0).abs() < 1.0e-3, "{rate} {step}: {} {expected}", std * std);
            }
        }
    }

    /// A constant measured for long, from a start that knows nothing: the mean goes to y as 1/(1 + P₀ t/r).
    #[test]
    fn the_mean_goes_to_what_is_measured() {
        let drive = Drive { process_density: [0.0], measured: [3.0], noise_density: [0.5] };
        let mut filter = KalmanBucyFilter::new([1.0], [2.0]);
        filter.advance(0.7, &Scalar { rate: 0.0 }, &drive).expect("positive definite");
        let expected = 3.0 - 2.0 / (1.0 + 4.0 * 0.7 / 0.5);
        let [mean] = filter.mean();
        assert!((mean - expected).abs() < 1.0e-4, "{mean} {expected}");
    }
}
