//! The average of what the rover network says along the way.

use super::travel_mean::TravelMean;
use crate::math;
use crate::network::{OUTPUTS, TARGETS};

/// Travel over which instants are averaged, m.
const LENGTH_M: f32 = 2.0;
/// Travel between instants that count as independent, m: what the filters remember where the ground changes nothing.
const INDEPENDENT_M: f32 = 0.3;

/// A running average of network outputs: means and log-variances over those of the prior.
///
/// The error of an instant has two parts. That of the sensors' white noise averages away. What no amount of averaging
/// removes — the soil's other parameters, the camera's bias, the network's own error — is what the network leaves when it
/// is told of hardly any noise; it stays.
#[derive(Debug, Clone)]
pub(super) struct SoilAverage {
    means: [TravelMean; TARGETS],
    variances: [TravelMean; TARGETS],
    lasting: [TravelMean; TARGETS],
}

impl SoilAverage {
    /// An empty average.
    pub const fn new() -> Self {
        let empty = [TravelMean::new(LENGTH_M); TARGETS];
        Self { means: empty, variances: empty, lasting: empty }
    }

    /// Takes the outputs of an instant that held over some travel, m.
    pub fn take(&mut self, outputs: &[f32; OUTPUTS], travel_m: f32) {
        let [m0, m1, m2, v0, v1, v2] = *outputs;
        let places = self.means.iter_mut().zip(&mut self.variances);
        for ((mean, variance), (m, v)) in places.zip([(m0, v0), (m1, v1), (m2, v2)]) {
            mean.take(m, travel_m);
            variance.take(math::exp(v), travel_m);
        }
    }

    /// Takes the outputs for the same wheels, had they been seen almost without noise.
    pub fn take_noiseless(&mut self, outputs: &[f32; OUTPUTS], travel_m: f32) {
        let [.., v0, v1, v2] = *outputs;
        for (lasting, v) in self.lasting.iter_mut().zip([v0, v1, v2]) {
            lasting.take(math::exp(v), travel_m);
        }
    }

    /// How many independent instants the average is worth.
    pub fn instants(&self) -> f32 {
        let [first, ..] = &self.means;
        let travel = if first.travel_m() < LENGTH_M { first.travel_m() } else { LENGTH_M };
        1.0 + travel / INDEPENDENT_M
    }

    /// The average as outputs; none before the first instant.
    pub fn outputs(&self) -> Option<[f32; OUTPUTS]> {
        let [m0, m1, m2] = &self.means;
        if m0.travel_m() <= 0.0 {
            return None;
        }
        let share = 1.0 / self.instants();
        let mut log_variances = [0.0; TARGETS];
        let parts = self.variances.iter().zip(&self.lasting);
        for (place, (variance, lasting)) in log_variances.iter_mut().zip(parts) {
            let whole = variance.mean();
            // Until it is known what lasts, everything does.
            let lasting = if lasting.travel_m() > 0.0 && lasting.mean() < whole { lasting.mean() } else { whole };
            *place = math::ln(lasting + share * (whole - lasting));
        }
        let [v0, v1, v2] = log_variances;
        Some([m0.mean(), m1.mean(), m2.mean(), v0, v1, v2])
    }
}
