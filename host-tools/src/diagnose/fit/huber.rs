//! Huber's loss (Huber 1964, Ann. Math. Statist. 35:73): squares in the bulk, absolute values in the tails.

use statrs::function::erf::erf;

/// Huber's loss with threshold `k` in standard deviations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Huber {
    k: f64,
}

impl Huber {
    pub(super) fn new(k: f64) -> Self {
        Self { k }
    }

    /// ρ of a standardised residual: half its square within the threshold.
    pub(super) fn loss(self, t: f64) -> f64 {
        let size = t.abs();
        if size <= self.k { 0.5 * t * t } else { self.k * (size - 0.5 * self.k) }
    }

    /// Weight of the reading in a least-squares step: ρ'(t) / t.
    pub(super) fn weight(self, t: f64) -> f64 {
        let size = t.abs();
        if size <= self.k { 1.0 } else { self.k / size }
    }

    /// ln ∫ exp(−ρ(t)) dt: what makes a density of the loss.
    pub(super) fn ln_integral(self) -> f64 {
        let root = (2.0 * std::f64::consts::PI).sqrt();
        if self.k.is_infinite() {
            return root.ln();
        }
        let tails = 2.0 / self.k * (-0.5 * self.k * self.k).exp();
        (root * erf(self.k * std::f64::consts::FRAC_1_SQRT_2) + tails).ln()
    }
}
