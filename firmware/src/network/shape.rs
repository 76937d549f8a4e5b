//! The sizes of the two networks, and what stands in which place.

/// Inputs that each wheel has of its own: DP/W, T/(rW), slip, the fifth input, ln(W/(rb)).
pub const WHEEL_FEATURES: usize = 5;
/// Inputs that all wheels share: wheel geometry (2) and how noisy the states are (5).
pub const CONTEXT_FEATURES: usize = 7;
/// Inputs of the per-wheel network: a wheel's own and the shared ones.
pub const WHEEL_INPUTS: usize = WHEEL_FEATURES + CONTEXT_FEATURES;
/// What is estimated: ln c, φ, ln K.
pub const TARGETS: usize = 3;
/// Outputs of a network: a mean and a log-variance for each target.
pub const OUTPUTS: usize = 2 * TARGETS;

/// Neurons in each hidden layer of the per-wheel network.
pub const WHEEL_HIDDEN: usize = 16;

/// The most wheels that the rover network takes.
pub const ROVER_WHEELS: usize = 6;
/// Neurons in the first layer that the wheels share.
pub const ROVER_HIDDEN: usize = 24;
/// Neurons whose mean and variance over the wheels are pooled.
pub const ROVER_POOLED: usize = 16;
/// Inputs of the layer behind the pool: means, variances, the shared inputs and the number of wheels.
pub const ROVER_HEAD_INPUTS: usize = 2 * ROVER_POOLED + CONTEXT_FEATURES + 1;
/// Neurons in the layer behind the pool.
pub const ROVER_HEAD: usize = 16;

/// Layer sizes of the per-wheel network, as its frozen table states them.
pub const WHEEL_SHAPE: [usize; 4] = [WHEEL_INPUTS, WHEEL_HIDDEN, WHEEL_HIDDEN, OUTPUTS];
/// Layer sizes of the rover network, as its frozen table states them.
pub const ROVER_SHAPE: [usize; 6] = [CONTEXT_FEATURES, WHEEL_FEATURES, ROVER_HIDDEN, ROVER_POOLED, ROVER_HEAD, OUTPUTS];
