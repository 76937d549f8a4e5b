//! Whether posteriors are calibrated: the rank of the truth among their draws is uniform.
//!
//! S. Talts, M. Betancourt, D. Simpson, A. Vehtari, A. Gelman, "Validating Bayesian inference algorithms with
//! simulation-based calibration" (2018).

use crate::statistics::sorted;

/// Distance of the distribution of ranks (each 0 … 1) from the uniform one: Kolmogorov's statistic.
pub fn distance_from_uniform(ranks: Vec<f64>) -> f64 {
    let ranks = sorted(ranks);
    let count = ranks.len() as f64;
    let gap = |(place, rank): (usize, &f64)| (rank - place as f64 / count).max((place as f64 + 1.0) / count - rank);
    ranks.iter().enumerate().map(gap).fold(0.0, f64::max)
}

/// The distance that `count` uniform ranks exceed with less than the given probability (the inequality of Dvoretzky, Kiefer
/// and Wolfowitz with Massart's constant).
pub fn distance_bound(count: usize, probability: f64) -> f64 {
    libm::sqrt(libm::log(2.0 / probability) / (2.0 * count as f64))
}
