//! What is believed of a soil before any wheel has rolled over it.

use crate::scalar::Scalar;

/// What is believed of one number: normal with a mean and a standard deviation, and surely between two bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Belief<S> {
    /// The mean.
    pub mean: S,
    /// One standard deviation; none where every value between the bounds is as good as any other; zero where the number
    /// is held to be known.
    pub std: Option<S>,
    /// The least value.
    pub low: S,
    /// The greatest value.
    pub high: S,
}

/// What is believed of a soil. Cohesion, shear modulus and stiffness by their logarithms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SoilPrior<S> {
    /// ln c, c in Pa.
    pub ln_cohesion: Belief<S>,
    /// φ, rad.
    pub friction_angle_rad: Belief<S>,
    /// ln K, K in m.
    pub ln_shear_modulus: Belief<S>,
    /// ln(k_c/b + k_φ), the stiffness in Pa/mⁿ.
    pub ln_stiffness: Belief<S>,
    /// n.
    pub sinkage_exponent: Belief<S>,
    /// c₁.
    pub peak_stress_c1: Belief<S>,
    /// c₂.
    pub peak_stress_c2: Belief<S>,
    /// η.
    pub rebound_ratio: Belief<S>,
}

impl<S: Scalar> Belief<S> {
    fn normal(mean: f64, std: f64, low: f64, high: f64) -> Self {
        let [mean, std, low, high] = [mean, std, low, high].map(S::constant);
        Self { mean, std: Some(std), low, high }
    }

    /// A number that is held to be known.
    pub fn known(value: S) -> Self {
        Self { mean: value, std: Some(S::zero()), low: value, high: value }
    }
}

impl<S: Scalar> SoilPrior<S> {
    /// What is believed where nothing is known of the soil but that wheels drive on it: c about 400 Pa and φ about 32°
    /// within 1.2 in ln c and 6°, K about 13 mm within 0.6 in ln K, and of stiffness, exponent and position of the peak
    /// stress what the soils of the literature have. No rear contact.
    pub fn usual() -> Self {
        Self {
            ln_cohesion: Belief::normal(5.991_464_547_107_98, 1.2, -2.3, 11.5),
            friction_angle_rad: Belief::normal(0.558_505_360_638_185, 0.104_719_755_119_659_8, 0.02, 1.15),
            ln_shear_modulus: Belief::normal(-4.342_805_921_520_59, 0.6, -9.2, -1.6),
            ln_stiffness: Belief::normal(14.3, 1.0, 9.2, 18.4),
            sinkage_exponent: Belief::normal(1.05, 0.25, 0.1, 2.2),
            peak_stress_c1: Belief::normal(0.32, 0.13, -0.2, 0.9),
            peak_stress_c2: Belief::normal(0.18, 0.15, -0.6, 1.0),
            rebound_ratio: Belief::known(S::zero()),
        }
    }
}
