//! What a fit leaves of a channel, and how well that tells the channel's noise.

use super::huber::Huber;
use super::observation::Reading;
use super::outcome::Fit;

/// Of all readings of a channel together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChannelSquares {
    /// How many there are.
    pub count: f64,
    /// Twice the loss of what is left of them, in units of their noise: their squares, where none is a gross error.
    pub squares: f64,
    /// Sum of ln of their noise as the fit has it.
    pub ln_noise: f64,
    /// How many of them the noise can be told from: their number less what was fitted of them.
    pub freedom: f64,
}

impl Fit {
    /// Whether the noise of a channel is estimated.
    pub fn estimates_noise(&self, channel: Reading) -> bool {
        self.options.estimate_noise[channel.index()]
    }

    /// How many parameters the readings tell, not their priors: the trace of the readings' information times the covariance.
    pub fn parameters_told(&self) -> f64 {
        let of_readings: f64 =
            self.shares.iter().map(|share| share.information.component_mul(&self.covariance).sum()).sum();
        of_readings.clamp(0.0, self.parameters.len() as f64)
    }

    /// What is left of a channel; none of one that was not measured.
    pub fn channel_squares(&self, channel: Reading) -> Option<ChannelSquares> {
        let c = channel.index();
        let (huber, scales) = (Huber::new(self.options.huber), self.scales());
        let mut all = ChannelSquares { count: 0.0, squares: 0.0, ln_noise: 0.0, freedom: 0.0 };
        for ((row, left), leverages) in self.rows.iter().zip(&self.standardised).zip(&self.leverages) {
            if let Some(left) = left[c] {
                all.count += 1.0;
                all.squares += 2.0 * huber.loss(left);
                all.ln_noise += scales.noise(row, c).ln();
                all.freedom += 1.0 - leverages[c];
            }
        }
        (all.count > 0.0).then_some(all)
    }
}
