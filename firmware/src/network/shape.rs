//! The sizes of the two networks, and what stands in which place.

/// Inputs that each wheel has of its own: DP/W, T/(rW), slip, the fifth input, ln(W/(rb)).
pub const WHEEL_FEATURES: usize = 5;
/// Place of the slip among them.
pub const WHEEL_SLIP: usize = 2;
/// Place of ln(W/(rb)) among them.
pub const WHEEL_LN_LOAD: usize = 4;
/// Inputs that all wheels share: wheel geometry (2) and how noisy the states are (5).
pub const CONTEXT_FEATURES: usize = 7;
/// Inputs of the rover network that say how the wheels' states go with slip and load.
pub const TREND_FEATURES: usize = 19;
/// Inputs that all wheels of the rover network share.
pub const ROVER_CONTEXT: usize = CONTEXT_FEATURES + TREND_FEATURES;
/// Inputs of the per-wheel network: a wheel's own and the shared ones.
pub const WHEEL_INPUTS: usize = WHEEL_FEATURES + CONTEXT_FEATURES;
/// What is estimated: ln c, φ, ln K.
pub const TARGETS: usize = 3;
/// Outputs of a network: a mean and a log-variance for each target.
pub const OUTPUTS: usize = 2 * TARGETS;

/// Neurons in each hidden layer of the per-wheel network; a multiple of four.
pub const WHEEL_HIDDEN: usize = 16;

/// The most wheels that the rover network takes.
pub const ROVER_WHEELS: usize = 6;
/// Inputs of the rover network: the shared ones, six wheels' own, and the number of wheels.
pub const ROVER_INPUTS: usize = ROVER_CONTEXT + ROVER_WHEELS * WHEEL_FEATURES + 1;
/// Neurons in the first layer of the rover network; a multiple of four, like the next two.
pub const ROVER_FIRST: usize = 76;
/// Neurons in the second layer.
pub const ROVER_SECOND: usize = 56;
/// Neurons in the third layer. Of networks with as many numbers, three layers learn the map to a lower loss than two.
pub const ROVER_THIRD: usize = 44;

const _: () = assert!(
    WHEEL_HIDDEN.is_multiple_of(4)
        && ROVER_FIRST.is_multiple_of(4)
        && ROVER_SECOND.is_multiple_of(4)
        && ROVER_THIRD.is_multiple_of(4),
    "layers are worked through by fours"
);

/// Layer sizes of the per-wheel network, as its frozen table states them.
pub const WHEEL_SHAPE: [usize; 4] = [WHEEL_INPUTS, WHEEL_HIDDEN, WHEEL_HIDDEN, OUTPUTS];
/// Layer sizes of the rover network, as its frozen table states them.
pub const ROVER_SHAPE: [usize; 5] = [ROVER_INPUTS, ROVER_FIRST, ROVER_SECOND, ROVER_THIRD, OUTPUTS];
