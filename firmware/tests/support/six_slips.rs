//! The slips of six wheels.

/// In equal steps.
pub const SIX_SLIPS: [f64; 6] = [0.05, 0.16, 0.27, 0.38, 0.49, 0.60];
