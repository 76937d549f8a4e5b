//! What is known of a drawn campaign's soil by other means: n, k, c₁ and c₂ to 5–10 %, or nothing.

use super::chance::Chance;
use super::refit::PRIOR_STD;
use super::site::Site;

/// One standard deviation of a known parameter over its value.
const RELATIVE_STD: (f64, f64) = (0.05, 0.10);
/// The least standard deviation of c₁ and c₂, which may be near zero.
const LEAST_POSITION_STD: f64 = 0.01;

/// A value and its standard deviation, for each parameter that is known.
#[derive(Debug, Clone, PartialEq)]
pub struct Knowledge(Option<[Known; 4]>);

#[derive(Debug, Clone, Copy, PartialEq)]
struct Known {
    key: &'static str,
    value: f64,
    std: f64,
}

impl Knowledge {
    /// Nothing is known.
    pub fn none() -> Self {
        Self(None)
    }

    /// Values about the truth, with the standard deviations that they are stated with.
    pub fn draw(chance: &mut Chance, site: &Site) -> Self {
        let mut about = |key, truth: f64, least_std: f64| {
            let std = (truth.abs() * chance.between(RELATIVE_STD.0, RELATIVE_STD.1)).max(least_std);
            Known { key, value: truth + chance.normal(std), std }
        };
        let soil = &site.soil;
        Self(Some([
            about("n", soil.sinkage_exponent, 0.0),
            about("k_eff", soil.stiffness(site.wheel.width_m), 0.0),
            about("c1", soil.peak_stress_c1, LEAST_POSITION_STD),
            about("c2", soil.peak_stress_c2, LEAST_POSITION_STD),
        ]))
    }

    /// Whether anything is.
    pub fn is_some(&self) -> bool {
        self.0.is_some()
    }

    /// The table `[soil]` of the campaign's file, without its head.
    pub fn toml(&self) -> String {
        let known = self.0.iter().flatten();
        known
            .map(|known| format!("{} = {{ value = {:.4e}, std = {:.2e} }}\n", known.key, known.value, known.std))
            .collect()
    }

    /// Standard deviations in the order and the units of [`PRIOR_STD`].
    pub fn std(&self) -> [f64; 7] {
        let mut std = PRIOR_STD;
        if let Some([n, stiffness, c1, c2]) = self.0 {
            std[3..].copy_from_slice(&[n.std, stiffness.std / stiffness.value, c1.std, c2.std]);
        }
        std
    }
}
