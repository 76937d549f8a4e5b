//! Observations made by the equations: Kapvik's assumed wheel on the seed's sand.

use kapvik_firmware::identification::Observation;
use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::wheel_state::{WheelNoise, WheelState};

pub use super::kapvik::{kapvik_wheel, table_1_sand};
pub use super::six_slips::SIX_SLIPS;

/// The load of each wheel where all carry the same, N.
pub const EQUAL_LOAD_N: f64 = 65.4;
/// The noise of one instant.
pub const NOISE: WheelNoise<f64> =
    WheelNoise { drawbar_pull_n: 0.5, load_n: 1.0, torque_nm: 0.05, slip: 0.01, sinkage_m: 0.002 };

/// What faultless sensors read of Kapvik's wheel at a slip and a load.
pub fn seen(soil: &Soil<f64>, slip: f64, load_n: f64) -> Observation<f64> {
    let state = WheelState::under_load(&kapvik_wheel(), soil, slip, load_n).expect("carried");
    Observation { state, noise: NOISE }
}

/// Six wheels under equal loads.
pub fn six_wheels(soil: &Soil<f64>) -> [Observation<f64>; 6] {
    SIX_SLIPS.map(|slip| seen(soil, slip, EQUAL_LOAD_N))
}

/// The same observation in single precision.
pub fn single(observation: &Observation<f64>) -> Observation<f32> {
    Observation {
        state: observation.state.map(|number| number as f32),
        noise: observation.noise.map(|number| number as f32),
    }
}

/// Standard normal numbers, the same for the same seed: Box and Muller's on the generator SplitMix64.
pub struct Normal {
    state: u64,
}

impl Normal {
    /// Starts a stream.
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// The next number.
    pub fn next(&mut self) -> f64 {
        let (radius, angle) = (self.share(), self.share());
        (-2.0 * radius.ln()).sqrt() * (std::f64::consts::TAU * angle).cos()
    }

    /// An even chance between two bounds.
    pub fn even(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.share()
    }

    fn share(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.state;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64 + f64::EPSILON
    }
}

/// The observation with noise drawn.
pub fn noisy(observation: &Observation<f64>, random: &mut Normal) -> Observation<f64> {
    let state = observation.state.blurred(&observation.noise, || random.next());
    Observation { state, ..*observation }
}

/// The same observation as the mean of many instants.
pub fn averaged(observation: &Observation<f64>, instants: f64) -> Observation<f64> {
    Observation { noise: observation.noise.map(|std| std / instants.sqrt()), ..*observation }
}
