//! The posterior density of the soil, given a noisy observation of its wheels.

use kapvik_firmware::terramechanics::Wheel;
use kapvik_firmware::wheel_state::{SoilQuery, WHEELS};
use nalgebra::{SMatrix, SVector};

use super::coordinates::{Coordinates, DIMENSION};
use super::wheel_likelihood::{Explanation, LoadPrior, WheelObservation, Whitening};
use crate::prior;

/// Residuals of the prior and of three channels of six wheels.
pub const RESIDUALS: usize = DIMENSION + 3 * WHEELS;

/// Residuals of prior and likelihood, each of unit variance under the model.
pub type Residuals = SVector<f64, RESIDUALS>;

/// Change of the residuals with the coordinates.
pub type Jacobian = SMatrix<f64, RESIDUALS, DIMENSION>;

/// Sinkage of each wheel, m.
pub type Sinkages = heapless::Vec<f64, WHEELS>;

/// What whitens the deviations of each wheel.
pub type Whitenings = heapless::Vec<Whitening, WHEELS>;

/// Prior times likelihood in the coordinates of [`super::coordinates`].
#[derive(Debug, Clone)]
pub struct SoilPosterior {
    wheel: Wheel<f64>,
    wheels: heapless::Vec<WheelObservation, WHEELS>,
    load: LoadPrior,
}

/// The posterior at a point.
#[derive(Debug, Clone)]
pub struct Evaluation {
    /// The point.
    pub point: Coordinates,
    /// Logarithm of the density, but for a constant.
    pub ln_density: f64,
    wheels: heapless::Vec<Explanation, WHEELS>,
}

impl SoilPosterior {
    /// Of an observation.
    pub fn new(query: &SoilQuery, load: LoadPrior) -> Self {
        Self {
            wheel: Wheel { radius_m: f64::from(query.wheel.radius_m), width_m: f64::from(query.wheel.width_m) },
            wheels: query.wheels.iter().map(|state| WheelObservation::new(state, &query.noise)).collect(),
            load,
        }
    }

    /// A guess of the sinkages where nothing better is known, m.
    pub fn guess(&self) -> Sinkages {
        self.wheels.iter().map(|_| 0.25 * self.wheel.radius_m).collect()
    }

    /// The posterior at a point; none where the soil cannot carry the wheels, or only deeper than the prior has them. The sinkages are looked for first at `near`.
    pub fn evaluate(&self, point: &Coordinates, near: &Sinkages) -> Option<Evaluation> {
        let mut ln_density = -0.5 * point.norm_squared();
        let mut wheels = heapless::Vec::new();
        for (observed, &guess_m) in self.wheels.iter().zip(near) {
            let explained = observed.explain(&self.wheel, point, self.load, guess_m)?;
            if explained.mean_sinkage_m > prior::DEEPEST * self.wheel.radius_m {
                return None;
            }
            ln_density += explained.ln_likelihood;
            wheels.push(explained).ok()?;
        }
        Some(Evaluation { point: *point, ln_density, wheels })
    }
}

impl Evaluation {
    /// What whitens the deviations here.
    pub fn whitenings(&self) -> Whitenings {
        self.wheels.iter().map(|wheel| wheel.whitening).collect()
    }

    /// The residuals and, to first order, their changes, whitened as stated.
    pub fn residuals(&self, whitenings: &Whitenings) -> (Residuals, Jacobian) {
        let (mut residuals, mut jacobian) = (Residuals::zeros(), Jacobian::zeros());
        residuals.fixed_rows_mut::<DIMENSION>(0).copy_from(&self.point);
        jacobian.fixed_rows_mut::<DIMENSION>(0).fill_with_identity();
        for (place, (wheel, whitening)) in self.wheels.iter().zip(whitenings).enumerate() {
            let row = DIMENSION + 3 * place;
            residuals.fixed_rows_mut::<3>(row).copy_from(&whitening.apply(wheel.deviation));
            jacobian.fixed_rows_mut::<3>(row).copy_from(&whitening.apply(wheel.slopes));
        }
        (residuals, jacobian)
    }

    /// The sinkages to expect at another point, m.
    pub fn sinkages_near(&self, point: &Coordinates) -> Sinkages {
        let step = point - self.point;
        let ahead = |wheel: &Explanation| {
            let share = wheel.slopes.row(2).transpose().dot(&step) / wheel.sinkage_m;
            wheel.sinkage_m * libm::exp(share.clamp(-1.0, 1.0))
        };
        self.wheels.iter().map(ahead).collect()
    }
}
