//! Inputs and the outputs that a sound table gives for them, bit for bit.

use super::shape::{OUTPUTS, ROVER_CONTEXT, ROVER_WHEELS, WHEEL_FEATURES, WHEEL_INPUTS};
use super::words;

/// Golden pairs of each network in a table's file, which the build script proves.
pub const GOLDEN_PAIRS: usize = 32;
/// The first of them, which fly and are proved again at boot. A checksum guards the weights; these guard the arithmetic, and
/// more would take the place of weights.
pub const FLOWN_PAIRS: usize = 1;

/// A pair of the per-wheel network: inputs before normalisation, outputs as the network gives them.
#[derive(Debug, Clone, PartialEq)]
pub struct WheelGolden {
    /// Inputs.
    pub input: [f32; WHEEL_INPUTS],
    /// Outputs.
    pub output: [f32; OUTPUTS],
}
words!(WheelGolden: input, output);

impl WheelGolden {
    /// All zero, for a table that is about to be filled.
    pub const ZERO: Self = Self { input: [0.0; WHEEL_INPUTS], output: [0.0; OUTPUTS] };
}

/// A pair of the rover network: inputs before normalisation, outputs as the network gives them.
#[derive(Debug, Clone, PartialEq)]
pub struct RoverGolden {
    /// Number of wheels, 1 … 6.
    pub count: f32,
    /// Inputs that the wheels share.
    pub context: [f32; ROVER_CONTEXT],
    /// Inputs of each wheel; those beyond `count` are of no account.
    pub wheels: [[f32; WHEEL_FEATURES]; ROVER_WHEELS],
    /// Outputs.
    pub output: [f32; OUTPUTS],
}
words!(RoverGolden: count, context, wheels, output);

impl RoverGolden {
    /// All zero, for a table that is about to be filled.
    pub const ZERO: Self = Self {
        count: 0.0,
        context: [0.0; ROVER_CONTEXT],
        wheels: [[0.0; WHEEL_FEATURES]; ROVER_WHEELS],
        output: [0.0; OUTPUTS],
    };
}
