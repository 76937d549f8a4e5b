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
    /// ln(k_c/b + k_φ) at the mean exponent n̄, the stiffness in Pa/mⁿ. At another exponent the belief is of
    /// ln(k_c/b + k_φ) + (n − n̄) ln z₀, z₀ being [`SoilPrior::known_depth_m`].
    pub ln_stiffness: Belief<S>,
    /// The depth z₀, m, at which the pressure (k_c/b + k_φ) z₀ⁿ is believed whatever n is. The unit of the stiffness
    /// changes with n: at 1 m, where the stiffness is that pressure, no shallow wheel has been, and to believe in k and n
    /// apart is to believe in pressures at 1–2 cm that are a hundred times too great or too small.
    pub known_depth_m: S,
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

    /// Every value between two bounds is as good as any other.
    pub fn flat(low: S, high: S) -> Self {
        Self { mean: S::constant(0.5) * (low + high), std: None, low, high }
    }

    /// A number that is held to be known.
    pub fn known(value: S) -> Self {
        Self { mean: value, std: Some(S::zero()), low: value, high: value }
    }

    /// Whether the number is held to be known.
    pub fn is_known(&self) -> bool {
        self.std.is_some_and(|std| std <= S::zero())
    }

    /// One standard deviation: the stated one, or that of a flat belief, the root of a twelfth of its range's square.
    pub fn spread(&self) -> S {
        self.std.unwrap_or((self.high - self.low) * S::constant(0.288_675_134_594_812_9))
    }

    /// The bounds are in order and the mean lies between them, the standard deviation is not below zero, and the numbers
    /// are finite.
    pub fn is_valid(&self) -> bool {
        [self.mean, self.low, self.high, self.spread()].iter().all(|number| number.is_finite())
            && self.low <= self.mean
            && self.mean <= self.high
            && self.spread() >= S::zero()
            && (self.low < self.high || self.is_known())
    }
}

impl<S: Scalar> SoilPrior<S> {
    /// What is believed where nothing is known of the soil but that wheels drive on it: c about 400 Pa and φ about 32°
    /// within 1.2 in ln c and 6°, K about 13 mm within 0.6 in ln K, as the soils of the literature have them
    /// (`kapvik soils`), and so the rest: a pressure at 15 mm of about 20 kPa within a factor of 2.2, as the sands
    /// and regoliths have it, whatever the exponent; n 1.05 ± 0.25; c₁ 0.32 ± 0.12 and c₂ 0.25 ± 0.15, the
    /// spread of the ten wheels with figures of their own. No rear contact.
    pub fn usual() -> Self {
        Self {
            ln_cohesion: Belief::normal(5.991_464_547_107_98, 1.2, -2.3, 11.5),
            friction_angle_rad: Belief::normal(0.558_505_360_638_185, 0.104_719_755_119_659_8, 0.02, 1.15),
            ln_shear_modulus: Belief::normal(-4.342_805_921_520_59, 0.6, -9.2, -1.6),
            ln_stiffness: Belief::normal(14.3, 0.8, 9.2, 18.4),
            known_depth_m: S::constant(0.015),
            sinkage_exponent: Belief::normal(1.05, 0.25, 0.1, 2.2),
            peak_stress_c1: Belief::normal(0.32, 0.12, 0.02, 0.9),
            peak_stress_c2: Belief::normal(0.25, 0.15, -0.3, 1.0),
            rebound_ratio: Belief::known(S::zero()),
        }
    }
}
