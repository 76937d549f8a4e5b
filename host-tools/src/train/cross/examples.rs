//! Drawn soils and what theory says of a wheel on them.

use kapvik_firmware::wheel_state::WheelState;
use rand::RngExt;

use super::super::dataset::stream;
use super::super::example::soil_targets;
use super::{INPUTS, Scope, TARGETS};
use crate::prior::{self, DEEPEST, Range, SOIL_PARAMETERS};

// Wide enough for most soils of the literature; ours, not the paper's.
// The order is that of [`prior::SOIL_RANGES`].
const SOIL_RANGES: [Range; SOIL_PARAMETERS] = [
    Range { low: 50.0, high: 5000.0, logarithmic: true },
    Range { low: 20.0_f64.to_radians(), high: 45.0_f64.to_radians(), logarithmic: false },
    Range { low: 0.004, high: 0.040, logarithmic: true },
    Range { low: 0.6, high: 1.5, logarithmic: false },
    Range { low: 2e5, high: 6e6, logarithmic: true },
    Range { low: 0.15, high: 0.5, logarithmic: false },
    Range { low: 0.0, high: 0.35, logarithmic: false },
];
const SLIP: Range = Range { low: 0.02, high: 0.7, logarithmic: false };

/// A wheel's state and the soil under it, in the units of inputs and targets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Example {
    pub input: [f64; INPUTS],
    pub target: [f64; TARGETS],
}

/// Brings numbers to −1 … 1 and back.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Scale<const N: usize> {
    low: [f64; N],
    high: [f64; N],
}

/// `count` examples, the same for the same seed. Draws in which the wheel is stuck are left out and replaced.
///
/// One after the other: who waits for a network is a worker of rayon, and one that shared out this work could be handed the task of another
/// who waits for the same.
pub(super) fn draw(scope: &Scope, count: usize, seed: u64) -> Vec<Example> {
    // Where next to no soil carries the wheel there are fewer.
    const MOST_ROUNDS: usize = 20;
    let mut examples = Vec::with_capacity(count);
    for round in 0..MOST_ROUNDS {
        examples.extend((round * count..(round + 1) * count).filter_map(|index| draw_one(scope, seed, index)));
        if examples.len() >= count {
            break;
        }
    }
    examples.truncate(count);
    examples
}

fn draw_one(scope: &Scope, seed: u64, index: usize) -> Option<Example> {
    let mut random = stream(seed, index);
    let mut at = |range: Range| range.at(random.random());
    let soil = prior::soil(SOIL_RANGES.map(&mut at));
    let (slip, load_n) = (at(SLIP), at(scope.load_n));
    let state = WheelState::under_load(&scope.wheel, &soil, slip, load_n).ok()?;
    let carried = state.sinkage_m? <= DEEPEST * scope.wheel.radius_m;
    carried.then_some(Example { input: input(&state)?, target: soil_targets(&soil) })
}

/// What the network is told of a wheel; none without sinkage.
pub(super) fn input(state: &WheelState<f64>) -> Option<[f64; INPUTS]> {
    Some([state.drawbar_pull_n, state.torque_nm, state.slip, state.sinkage_m?, state.load_n])
}

/// The scale of the targets: their ranges.
pub(super) fn target_scale() -> Scale<TARGETS> {
    let [cohesion, friction_angle, shear_modulus, ..] = &SOIL_RANGES;
    let ends = |end: fn(&Range) -> f64| [end(cohesion).ln(), end(friction_angle), end(shear_modulus).ln()];
    Scale { low: ends(|range| range.low), high: ends(|range| range.high) }
}

impl<const N: usize> Scale<N> {
    /// The least and the greatest of each number.
    pub fn of(all: impl Iterator<Item = [f64; N]>) -> Self {
        all.fold(Self { low: [f64::INFINITY; N], high: [f64::NEG_INFINITY; N] }, |ends, numbers| Self {
            low: std::array::from_fn(|k| ends.low[k].min(numbers[k])),
            high: std::array::from_fn(|k| ends.high[k].max(numbers[k])),
        })
    }

    /// To −1 … 1.
    pub fn apply(&self, numbers: &[f64; N]) -> [f64; N] {
        std::array::from_fn(|k| 2.0 * (numbers[k] - self.low[k]) / (self.high[k] - self.low[k]) - 1.0)
    }

    /// From −1 … 1.
    pub fn undo(&self, numbers: &[f64; N]) -> [f64; N] {
        std::array::from_fn(|k| self.low[k] + 0.5 * (numbers[k] + 1.0) * (self.high[k] - self.low[k]))
    }

    /// What one of the scaled unit is in each number's own.
    pub fn units(&self) -> [f64; N] {
        std::array::from_fn(|k| 0.5 * (self.high[k] - self.low[k]))
    }
}
