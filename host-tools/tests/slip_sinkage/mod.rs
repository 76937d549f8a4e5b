//! What sensors read of Kapvik's wheel on soils with slip-sinkage.

use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::wheel_state::{WheelNoise, WheelState};
use kapvik_host::prior;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// A soil whose sinkage exponent falls with slip.
pub struct Sinking {
    strength: [f64; 3],
    by_slip: f64,
}

impl Sinking {
    /// Of any strength, the exponent 1 less `by_slip` times the slip.
    pub fn drawn(by_slip: f64, random: &mut ChaCha8Rng) -> Self {
        Self { strength: [100.0..2000.0, 0.45..0.7, 0.005..0.03].map(|range| random.random_range(range)), by_slip }
    }

    /// What is read at a slip and a load.
    pub fn seen(&self, slip: f64, load_n: f64, noise: &WheelNoise<f64>, random: &mut ChaCha8Rng) -> WheelState<f64> {
        self.truth(slip, load_n).blurred(noise, || StandardNormal.sample(random))
    }

    /// The same without noise.
    pub fn truth(&self, slip: f64, load_n: f64) -> WheelState<f64> {
        let [cohesion, friction, shear] = self.strength;
        let soil: Soil<f64> = prior::soil([cohesion, friction, shear, 1.0 - self.by_slip * slip, 2e6, 0.3, 0.15]);
        WheelState::under_load(&prior::KAPVIK_WHEEL, &soil, slip, load_n).expect("a soil that carries")
    }
}
