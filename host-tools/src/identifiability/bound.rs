//! The bound of Cramér and Rao, and van Trees' where something is believed beforehand.

use kapvik_firmware::terramechanics::Soil;
use nalgebra::SMatrix;

use crate::parameter::Parameter;

use super::beforehand::{Beforehand, PARAMETERS};
use super::information::{Information, PITCH, SHARED, SPEED_SCALE, SharedInformation};

/// Observations that share no sensor but the velocimeter and the inclinometer: each with the number of times that it is
/// there, on sensors of its own.
pub type Observations<'a> = &'a [(Information, f64)];

/// The least standard deviations that an unbiased estimate can have; with a prior, the least that any can have on average,
/// to first order about the stated soil.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bound {
    stds: [f64; PARAMETERS],
}

impl Bound {
    /// From observations; none where a parameter of which nothing is known beforehand cannot be told at all.
    pub fn new(beforehand: &Beforehand, observations: Observations<'_>) -> Option<Self> {
        let parameters = beforehand.standardised();
        let mut whole = SharedInformation::zeros();
        for (place, parameter) in parameters.iter().enumerate() {
            whole[(place, place)] = parameter.precision;
        }
        whole[(SPEED_SCALE, SPEED_SCALE)] = 1.0;
        whole[(PITCH, PITCH)] = 1.0;
        for (information, count) in observations {
            whole += information.on_shared()? * *count;
        }
        let variances = whole.cholesky()?.solve(&SMatrix::<f64, SHARED, SHARED>::identity()).diagonal();
        let stds = std::array::from_fn(|place| parameters[place].scale * variances[place].sqrt());
        stds.iter().all(|std: &f64| std.is_finite()).then_some(Self { stds })
    }

    /// Standard deviation of ln c, φ (rad), ln K, n, ln(k_c/b + k_φ), c₁ and c₂.
    pub fn stds(&self) -> &[f64; PARAMETERS] {
        &self.stds
    }

    /// Standard deviation of ln c, φ (rad) or ln K.
    pub fn std(&self, target: Parameter) -> f64 {
        self.stds[target as usize]
    }

    /// Standard deviation of c, φ or K as a share of its value.
    pub fn relative(&self, target: Parameter, soil: &Soil<f64>) -> f64 {
        target.relative(self.std(target), soil)
    }
}
