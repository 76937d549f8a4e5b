//! What the network says of a soil that several wheels have seen.

use kapvik_firmware::identification::{Identified, Observation, Refusal, SoilPrior, Told};
use kapvik_firmware::wheel_state::WheelNoise;
use nalgebra::{DMatrix, SMatrix, SVector};

use super::examples::input;
use super::{CrossNetwork, INPUTS, TARGETS};

/// How far beyond the inputs that it was trained on the network is asked, as a share of half their range: sensors are noisy.
const BEYOND: f64 = 0.1;

impl CrossNetwork {
    /// Identifies the soil under some observations: the mean of what the network says of each, in ln c, φ and ln K, held
    /// in the ranges that it was trained on.
    ///
    /// Observations whose inputs lie outside those of training (braking wheels among them) are left out.
    ///
    /// The method gives no standard deviation. A parameter is held to be identifiable where the network's error on
    /// noise-free examples is small enough against what is believed beforehand, and its value is not at the end of its
    /// range; of noise the network knows nothing. The condition number is the greatest over the least gain by which the
    /// sensors' noise comes through to ln c, φ and ln K, each over its range.
    ///
    /// # Errors
    /// [`Refusal::TooFew`] without observations, [`Refusal::NoSinkage`], [`Refusal::NotFinite`], and
    /// [`Refusal::OutOfRange`] where no observation has inputs like those of training.
    pub fn identify(&self, observations: &[Observation<f64>]) -> Result<Identified<f64>, Refusal> {
        if observations.is_empty() {
            return Err(Refusal::TooFew { needed: 1 });
        }
        let mut inputs = Vec::new();
        for observation in observations {
            let input = input(&observation.state).ok_or(Refusal::NoSinkage)?;
            if !input.iter().all(|number| number.is_finite()) {
                return Err(Refusal::NotFinite);
            }
            let scaled = self.inputs.apply(&input);
            if scaled.iter().all(|number| number.abs() <= 1.0 + BEYOND) {
                inputs.push((scaled, &observation.noise));
            }
        }
        if inputs.is_empty() {
            return Err(Refusal::OutOfRange);
        }
        let sum = inputs.iter().map(|(input, _)| SVector::from(self.network.run(input))).sum::<SVector<f64, TARGETS>>();
        let mean = (sum / inputs.len() as f64).map(|output| output.clamp(-1.0, 1.0));
        Ok(self.told(&mean, self.noise_gain_ratio(&inputs)))
    }

    fn told(&self, output: &SVector<f64, TARGETS>, condition_number: f64) -> Identified<f64> {
        let prior = SoilPrior::<f64>::usual();
        let [ln_cohesion, friction_angle_rad, ln_modulus] = self.targets.undo(&(*output).into());
        let told = |value: f64, k: usize, believed: Option<f64>| {
            let told = Told::estimated(value, None, self.error[k] / believed.unwrap_or(1.0));
            Told { identifiable: told.identifiable && output[k].abs() < 1.0, ..told }
        };
        Identified {
            cohesion_pa: told(ln_cohesion.exp(), 0, prior.ln_cohesion.std),
            friction_angle_rad: told(friction_angle_rad, 1, prior.friction_angle_rad.std),
            shear_modulus_m: told(ln_modulus.exp(), 2, prior.ln_shear_modulus.std),
            condition_number,
        }
    }

    fn noise_gain_ratio(&self, inputs: &[([f64; INPUTS], &WheelNoise<f64>)]) -> f64 {
        let units = self.inputs.units();
        let mut gains = DMatrix::zeros(TARGETS, INPUTS * inputs.len());
        for (place, (input, noise)) in inputs.iter().enumerate() {
            let noise = [noise.drawbar_pull_n, noise.torque_nm, noise.slip, noise.sinkage_m, noise.load_n];
            let scaled: [f64; INPUTS] = std::array::from_fn(|k| noise[k] / units[k]);
            let gain = self.network.derivatives(input).by_inputs * SMatrix::from_diagonal(&SVector::from(scaled));
            gains.columns_mut(INPUTS * place, INPUTS).copy_from(&gain);
        }
        let values = gains.svd(false, false).singular_values;
        values.max() / values.min()
    }
}
