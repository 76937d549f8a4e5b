//! The likelihood of what one wheel showed, its true slip and true load integrated out.
//!
//! True slip i and true load W have flat priors (the load's may end at given bounds), so that given what was measured of
//! them they are normal about it. The other channels are linear in (i, W) over that spread to good approximation; so what
//! was measured of them is normal too, with the errors of slip and load added to its covariance:
//!
//! y ~ N(g(i, W), R),  R = diag(σ²_DP, σ²_T, σ²_z) + G diag(σ²_i, σ²_W) Gᵀ,  G = ∂g/∂(i, W).
//!
//! Bounds on the load add the share of W's posterior that lies between them.

use kapvik_firmware::terramechanics::Wheel;
use kapvik_firmware::wheel_state::{WheelNoise, WheelState};
use nalgebra::{Matrix3, SMatrix, Vector3};

use super::coordinates::{Coordinates, normal_distribution};
use super::response::{Channels, Response, Slopes, respond};

/// What one wheel showed, and how noisily.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WheelObservation {
    slip: f64,
    slip_std: f64,
    load_n: f64,
    load_std_n: f64,
    channels: Channels,
    channel_variances: Vector3<f64>,
    /// 3, or 2 where the sinkage was not seen: it is the last.
    seen: usize,
}

/// Where the true load of a wheel may lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LoadPrior {
    /// Anywhere, with equal density.
    Flat,
    /// Between two loads, N, with equal density.
    Between(f64, f64),
}

/// Makes channels independent and of unit variance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Whitening {
    /// Lower triangular root of the covariance: its first two rows do not know of a sinkage that was not seen.
    root: Matrix3<f64>,
    seen: usize,
}

/// How well a soil explains a wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Explanation {
    /// Logarithm of the likelihood, but for a constant.
    pub ln_likelihood: f64,
    /// What was predicted less what was measured of the channels.
    pub deviation: Channels,
    /// Change of the deviation with the soil.
    pub slopes: Slopes,
    /// What whitens the deviation.
    pub whitening: Whitening,
    /// Sinkage at the measured slip and load, m.
    pub sinkage_m: f64,
    /// Posterior mean of the true sinkage, m.
    pub mean_sinkage_m: f64,
}

impl Whitening {
    /// Channels, or several columns of them, whitened; zero for a channel that was not seen.
    pub fn apply<const C: usize>(&self, mut channels: SMatrix<f64, 3, C>) -> SMatrix<f64, 3, C> {
        self.root.solve_lower_triangular_unchecked_mut(&mut channels);
        channels.row_iter_mut().skip(self.seen).for_each(|mut unseen| unseen.fill(0.0));
        channels
    }

    fn ln_determinant(&self) -> f64 {
        self.root.diagonal().iter().take(self.seen).map(|&pivot| libm::log(pivot)).sum()
    }
}

impl WheelObservation {
    /// From the state of one wheel.
    pub fn new(state: &WheelState, noise: &WheelNoise) -> Self {
        let square = |std: f32| f64::from(std) * f64::from(std);
        let channels = [state.drawbar_pull_n, state.torque_nm, state.sinkage_m.unwrap_or(0.0)];
        Self {
            slip: f64::from(state.slip),
            slip_std: f64::from(noise.slip),
            load_n: f64::from(state.load_n),
            load_std_n: f64::from(noise.load_n),
            channels: Channels::from(channels.map(f64::from)),
            channel_variances: Vector3::from([noise.drawbar_pull_n, noise.torque_nm, noise.sinkage_m].map(square)),
            seen: if state.sinkage_m.is_some() { 3 } else { 2 },
        }
    }

    /// How well the soil at `point` explains the wheel; none where it cannot carry it. `guess_m` is where the sinkage is
    /// looked for first.
    pub fn explain(
        &self,
        wheel: &Wheel<f64>,
        point: &Coordinates,
        load: LoadPrior,
        guess_m: f64,
    ) -> Option<Explanation> {
        let Response { value, by_slip, by_load, by_soil } = respond(wheel, point, self.slip, self.load_n, guess_m)?;
        let (by_slip, by_load) = (by_slip * self.slip_std, by_load * self.load_std_n);
        let own = Matrix3::from_diagonal(&self.channel_variances);
        let variance = own + by_slip * by_slip.transpose() + by_load * by_load.transpose();
        let whitening = Whitening { root: variance.cholesky()?.unpack(), seen: self.seen };
        let deviation = value - self.channels;
        let residuals = whitening.apply(deviation);
        let (slip_gain, load_gain) = (whitening.apply(by_slip), whitening.apply(by_load));
        let (slip_shift, load_shift) = (-slip_gain.dot(&residuals), -load_gain.dot(&residuals));
        let load_share = self.share_between(load, load_shift, 1.0 - load_gain.norm_squared());
        Some(Explanation {
            ln_likelihood: -0.5 * residuals.norm_squared() - whitening.ln_determinant() + libm::log(load_share),
            deviation,
            slopes: by_soil,
            whitening,
            sinkage_m: value[2],
            mean_sinkage_m: value[2] + by_slip[2] * slip_shift + by_load[2] * load_shift,
        })
    }

    /// Share of the load's posterior within its prior; mean and variance in units of the measurement's.
    fn share_between(&self, prior: LoadPrior, mean: f64, variance: f64) -> f64 {
        let LoadPrior::Between(low, high) = prior else { return 1.0 };
        let std = libm::sqrt(variance.max(f64::MIN_POSITIVE));
        let standardised = |load_n: f64| ((load_n - self.load_n) / self.load_std_n - mean) / std;
        let (low, high) = (standardised(low), standardised(high));
        // Both in the lower tail, where the distribution function keeps its digits.
        let (low, high) = if low > 0.0 { (-high, -low) } else { (low, high) };
        normal_distribution(high) - normal_distribution(low)
    }
}
