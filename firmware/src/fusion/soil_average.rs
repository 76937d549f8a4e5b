//! The average of what the rover network says along the way.

use super::travel_mean::WeightedTravelMeans;
use crate::math;
use crate::network::{OUTPUTS, TARGETS};

/// Travel over which instants are remembered, m.
const LENGTH_M: f32 = 6.0;
/// Travel between instants that count as independent, m: what the filters remember where the ground changes nothing.
const INDEPENDENT_M: f32 = 0.6;
/// What an instant outside the training range counts, over one inside.
const OUTSIDE_COUNTS: f32 = 0.05;
/// By how many standard deviations of the prior ln c may be greater where ice cements the grains. The soils that the networks know have a
/// cohesion of 3 kPa at most, such a soil up to twice as much: what the network says of it is then no better than the prior.
const CEMENTED_LN_COHESION: f32 = 1.0;
/// The least log-variance of φ there, over that of the prior (3.7°): the networks put into φ what they do not know as cohesion.
const CEMENTED_FRICTION_ANGLE: f32 = -0.9;
/// Variance over that of the prior below which an instant counts no more than at it.
const LEAST_VARIANCE: f32 = 0.01;

/// A running average of network outputs: means and log-variances over those of the prior.
///
/// Instants are weighed by the inverse square of their variance: while the wheels slip alike, little is said and little
/// changes; what a minute of spread slips taught stays. The error of an instant has two parts. That of the sensors' white
/// noise averages away. What no amount of averaging removes — the soil's other parameters, the camera's bias, the network's
/// own error — is what the network leaves when it is told of hardly any noise; it is taken to be common to all instants,
/// so that standard deviations average, not variances. Instants that disagree by more than noise explains have errors that nobody
/// told the network of, as where a sensor is lost: what they disagree by beyond it does not average away, either.
#[derive(Debug, Clone)]
pub(super) struct SoilAverage {
    targets: [TargetAverage; TARGETS],
    travel_m: f32,
    /// Whether ice may cement the soil.
    may_be_cemented: bool,
}

/// The average of one target.
#[derive(Debug, Clone, Copy)]
struct TargetAverage {
    /// What is said, its square, standard deviation over that of the prior, and 1 for inputs inside the training range.
    said: WeightedTravelMeans<4>,
    lasting_std: WeightedTravelMeans<1>,
    /// The weight of the last instant.
    weight: f32,
}

impl TargetAverage {
    const EMPTY: Self =
        Self { said: WeightedTravelMeans::new(LENGTH_M), lasting_std: WeightedTravelMeans::new(LENGTH_M), weight: 1.0 };

    /// The mean, and the log-variance where this share of what does not last is left.
    #[inline(never)] // flash is scarcer than the time of a call
    fn outputs(&self, share: f32) -> (f32, f32) {
        let square = |std: f32| std * std;
        let ([mean, mean_square, std, _], [lasting_std]) = (*self.said.means(), *self.lasting_std.means());
        let whole = square(std);
        // Until it is known what lasts, everything does.
        let lasting = if self.lasting_std.is_empty() { whole } else { square(lasting_std) };
        let lasting = if lasting < whole { lasting } else { whole };
        let passing = whole - lasting;
        let unexplained = mean_square - square(mean) - passing;
        let unexplained = if unexplained > 0.0 { unexplained } else { 0.0 };
        (mean, math::ln(lasting + unexplained + share * passing))
    }
}

impl SoilAverage {
    /// An empty average, of a soil that ice may cement or not.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn new(may_be_cemented: bool) -> Self {
        Self { targets: [TargetAverage::EMPTY; TARGETS], travel_m: 0.0, may_be_cemented }
    }

    /// Takes the outputs of an instant that held over some travel, m, with its inputs inside the training range or not.
    pub fn take(&mut self, outputs: &[f32; OUTPUTS], inside: bool, travel_m: f32) {
        let [m0, m1, m2, v0, v1, v2] = *outputs;
        let (counts, inside) = if inside { (1.0, 1.0) } else { (OUTSIDE_COUNTS, 0.0) };
        for (target, (m, v)) in self.targets.iter_mut().zip([(m0, v0), (m1, v1), (m2, v2)]) {
            let variance = variance_over_prior(v);
            target.weight = counts / (variance * variance);
            target.said.take(&[m, m * m, math::sqrt(variance), inside], target.weight, travel_m);
        }
        self.travel_m += travel_m;
    }

    /// Takes the outputs for the same wheels, had they been seen almost without noise.
    pub fn take_noiseless(&mut self, outputs: &[f32; OUTPUTS], travel_m: f32) {
        let [.., v0, v1, v2] = *outputs;
        for (target, v) in self.targets.iter_mut().zip([v0, v1, v2]) {
            let variance = variance_over_prior(v);
            target.lasting_std.take(&[math::sqrt(variance)], target.weight, travel_m);
        }
    }

    /// How many independent instants the average is worth.
    pub fn instants(&self) -> f32 {
        let travel_m = if self.travel_m < LENGTH_M { self.travel_m } else { LENGTH_M };
        1.0 + travel_m / INDEPENDENT_M
    }

    /// Whether most of what was learned of φ came from inputs inside the training range.
    pub fn inside_training_range(&self) -> bool {
        let [_, friction_angle, _] = &self.targets;
        let [.., inside] = *friction_angle.said.means();
        inside > 0.5
    }

    /// Whether it has taken an instant.
    pub fn has_begun(&self) -> bool {
        self.travel_m > 0.0
    }

    /// The average as outputs; none before the first instant.
    pub fn outputs(&self) -> Option<[f32; OUTPUTS]> {
        if !self.has_begun() {
            return None;
        }
        let share = 1.0 / self.instants();
        let [(m0, v0), (m1, v1), (m2, v2)] = self.targets.each_ref().map(|target| target.outputs(share));
        if self.may_be_cemented {
            let v1 = if v1 < CEMENTED_FRICTION_ANGLE { CEMENTED_FRICTION_ANGLE } else { v1 };
            return Some([m0 + CEMENTED_LN_COHESION, m1, m2, 0.0, v1, v2]);
        }
        Some([m0, m1, m2, v0, v1, v2])
    }
}

/// The variance over that of the prior which an output says, kept from promising too much.
fn variance_over_prior(log_variance: f32) -> f32 {
    math::exp(math::limit(log_variance, -16.0, 0.0)) + LEAST_VARIANCE
}

#[cfg(test)]
mod tests {
    use super::{OUTPUTS, SoilAverage};

    /// The log-variance of ln K after so many decimetres of instants of one variance, which say so much more or less of it in turn, each for
    /// a metre; a tenth of their variance lasts.
    fn log_variance_of_k(more_or_less: f32) -> f32 {
        let mut average = SoilAverage::new(false);
        for decimetre in 0..60_u8 {
            let said = if decimetre / 10 % 2 == 0 { more_or_less } else { -more_or_less };
            average.take(&[0.0, 0.0, said, 0.0, 0.0, 0.1_f32.ln()], true, 0.1);
            average.take_noiseless(&[0.0, 0.0, said, 0.0, 0.0, 0.01_f32.ln()], 0.1);
        }
        let [.., log_variance]: [f32; OUTPUTS] = average.outputs().expect("instants were taken");
        log_variance
    }

    #[test]
    fn instants_that_differ_by_no_more_than_their_noise_average_away() {
        let (alike, differ) = (log_variance_of_k(0.0), log_variance_of_k(0.25));
        assert!(alike.exp() < 0.04 && differ == alike, "{} {}", alike.exp(), differ.exp());
    }

    #[test]
    fn instants_that_contradict_each_other_are_not_believed() {
        let variance = log_variance_of_k(0.6).exp();
        assert!(variance > 0.25 && variance < 0.4, "{variance}");
    }
}
