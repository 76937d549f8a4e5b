//! How much is drawn and how long is trained.

/// Sizes of a training run. The same plan and seed give the same bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Plan {
    /// Seed of every draw.
    pub seed: u32,
    /// Scenes that the networks are trained on.
    pub scenes: usize,
    /// Scenes that training is watched and intervals are calibrated on.
    pub held_out: usize,
    /// Passes over the scenes for the rover network, each with noise drawn anew.
    pub rover_epochs: usize,
    /// The same for the per-wheel network.
    pub wheel_epochs: usize,
    /// Scenes in the comparisons of trainers and of fifth inputs.
    pub comparison_scenes: usize,
    /// Steps of Levenberg–Marquardt in the comparison; the other trainers' passes are in proportion.
    pub comparison_steps: usize,
}

impl Plan {
    /// The run that makes the table that is shipped.
    pub fn full(seed: u32) -> Self {
        Self {
            seed,
            scenes: 1_000_000,
            held_out: 60_000,
            rover_epochs: 360,
            wheel_epochs: 20,
            comparison_scenes: 16_000,
            comparison_steps: 12,
        }
    }

    /// A run of a minute or two a network: enough to compare by what the networks know of the world.
    pub fn medium(seed: u32) -> Self {
        Self { scenes: 120_000, held_out: 20_000, rover_epochs: 60, wheel_epochs: 15, ..Self::full(seed) }
    }

    /// A run of seconds, to see that everything works; its table is not worth flying.
    pub fn quick(seed: u32) -> Self {
        Self {
            seed,
            scenes: 4_000,
            held_out: 3_000,
            rover_epochs: 6,
            wheel_epochs: 6,
            comparison_scenes: 1_200,
            comparison_steps: 2,
        }
    }

    /// A seed for one purpose.
    pub fn stream(&self, purpose: Purpose) -> u64 {
        u64::from(self.seed) << 32 | (purpose as u64) << 24
    }
}

/// What random numbers are for; each purpose has a stream of its own.
#[derive(Debug, Clone, Copy)]
pub enum Purpose {
    /// Initial weights.
    Weights = 1,
    /// Noise on the training scenes, one number an epoch.
    TrainingNoise = 2,
    /// Noise on the held-out scenes.
    HeldOutNoise = 3,
    /// Order of the examples, one number an epoch.
    Order = 4,
    /// Noise on the comparison scenes.
    ComparisonNoise = 5,
}
