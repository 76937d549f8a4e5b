//! The fifth input of the per-wheel network: the seed starts with sinkage and looks for one that is easier to measure.

use kapvik_firmware::soil::FifthInput;
use kapvik_firmware::wheel_state::{SoilQuery, WheelState};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::scene::Scene;

/// A candidate for the fifth input. All but sinkage come from sensors that Kapvik has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Candidate {
    /// No fifth input.
    None,
    /// Sinkage over radius; needs a sensor that Kapvik does not have.
    Sinkage,
    /// Slope under the rover, which at steady speed on plane ground is the arc tangent of its total DP/W; known to 1°.
    ContactAngle,
    /// Rim speed over the mean rim speed of the six wheels, as commanded.
    SpeedRatio,
    /// Sinkage less that of the other wheel of the bogie, over radius: the bogie's angle tells it where the ground was
    /// flat (assumed), to 0.35 mm on a bogie of 0.35 m (assumed) with an angle known to 0.001 rad.
    BogieSinkage,
}

impl Candidate {
    /// The one that the flight side makes, and that the shipped network takes.
    pub const SHIPPED: Self = Self::ContactAngle;

    /// All candidates, in the order of the table.
    pub const ALL: [Self; 5] = [Self::Sinkage, Self::None, Self::ContactAngle, Self::SpeedRatio, Self::BogieSinkage];

    /// Its name in the table and in the frozen file.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Sinkage => "sinkage",
            Self::ContactAngle => "contact angle",
            Self::SpeedRatio => "commanded speed ratio",
            Self::BogieSinkage => "bogie differential sinkage",
        }
    }

    /// The input for the wheel at `place`, as seen in `query`.
    pub fn observe(self, scene: &Scene, query: &SoilQuery, place: usize, random: &mut ChaCha8Rng) -> FifthInput {
        let radius = query.wheel.radius_m;
        let mut normal = || -> f32 { StandardNormal.sample(random) };
        let exactly = |value: f32| FifthInput { value, std: 1.0 };
        let sinkage = |state: &WheelState| state.sinkage_m.unwrap_or(0.0);
        match self {
            Self::None => FifthInput::UNKNOWN,
            Self::Sinkage => FifthInput::sinkage(&query.wheel, &query.wheels[place], &query.noise),
            Self::ContactAngle => FifthInput::slope(query.slope),
            Self::SpeedRatio => {
                let rim_speed = |state: &WheelState| 1.0 / (1.0 - state.slip);
                let mean = scene.wheels.iter().map(rim_speed).sum::<f32>() / scene.wheels.len() as f32;
                exactly(rim_speed(&scene.wheels[place]) / mean)
            }
            Self::BogieSinkage => {
                let mate = &scene.wheels[(place + 1) % scene.wheels.len()];
                exactly((sinkage(&scene.wheels[place]) - sinkage(mate) + 0.000_35 * normal()) / radius)
            }
        }
    }
}
