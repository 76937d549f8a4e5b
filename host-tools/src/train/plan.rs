//! How much is drawn and how long is trained.

use std::fmt;

/// How a network is shown the scenes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Passes {
    /// Passes over the scenes, each with noise drawn anew.
    pub epochs: usize,
    /// Examples in a mini-batch. What is left to learn late is small beside the scatter of truths about any estimate, so that
    /// a long training wants large batches; a short one wants steps.
    pub batch: usize,
}

impl Passes {
    /// Few enough passes for small batches.
    const fn short(epochs: usize) -> Self {
        Self { epochs, batch: 512 }
    }
}

impl fmt::Display for Passes {
    fn fmt(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(text, "{} in batches of {}", self.epochs, self.batch)
    }
}

/// Sizes of a training run. The same plan and seed give the same bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Plan {
    /// Seed of every draw.
    pub seed: u32,
    /// Scenes that the networks are trained on.
    pub scenes: usize,
    /// Scenes that training is watched and intervals are calibrated on.
    pub held_out: usize,
    /// How the rover network is shown the scenes.
    pub rover: Passes,
    /// The same for the per-wheel network.
    pub wheel: Passes,
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
            scenes: 6_000_000,
            held_out: 60_000,
            rover: Passes { epochs: 220, batch: 8192 },
            wheel: Passes::short(5),
            comparison_scenes: 16_000,
            comparison_steps: 12,
        }
    }

    /// A run of a minute or two a network: enough to compare by what the networks know of the world.
    pub fn medium(seed: u32) -> Self {
        Self {
            scenes: 120_000,
            held_out: 20_000,
            rover: Passes::short(60),
            wheel: Passes::short(15),
            ..Self::full(seed)
        }
    }

    /// A run of seconds, to see that everything works; its table is not worth flying.
    pub fn quick(seed: u32) -> Self {
        Self {
            seed,
            scenes: 4_000,
            held_out: 3_000,
            rover: Passes::short(6),
            wheel: Passes::short(6),
            comparison_scenes: 1_200,
            comparison_steps: 2,
        }
    }

    /// A run of a second, for tests of what is around a training: its table is good for nothing but being another.
    pub fn glance(seed: u32) -> Self {
        Self { scenes: 1500, held_out: 1200, rover: Passes::short(2), wheel: Passes::short(1), ..Self::quick(seed) }
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
