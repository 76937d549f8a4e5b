//! The earlier network of Cross, Ellery and 'Qadi (Journal of Terramechanics 50(3):165–174, 2013): from drawbar pull,
//! torque, slip, sinkage and load of one wheel to c, φ and K, trained on what classical wheel–soil theory says of drawn
//! soils, without noise. A reconstruction: the paper was not at hand, and its layers, ranges and errors are not known.
//!
//! Taken for it is what MATLAB's Neural Network Toolbox, with which the network was made, does unless told otherwise: one
//! hidden layer of ten bipolar sigmoids, a linear output, inputs and targets brought to −1 … 1, Levenberg–Marquardt on the
//! mean square error, 70 % of the examples to train on, 15 % to stop by and 15 % to test.
//!
//! Our readings: the targets are ln c, φ and ln K; the network is trained for the wheel at hand; what several wheels say is
//! averaged in the targets' units. Training takes seconds and gives the same network for the same seed, so that no file of
//! weights is needed.

mod examples;
mod identify;
mod network;
mod training;

use kapvik_firmware::terramechanics::Wheel;

use crate::prior::{KAPVIK_WHEEL, Range};

use examples::Scale;
use network::Network;
pub use training::{HeldOut, Trained, train};

/// Inputs: DP (N), T (N·m), slip, z (m), W (N).
const INPUTS: usize = 5;
/// Targets: ln c, φ, ln K.
const TARGETS: usize = 3;

/// What a network is trained for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scope {
    /// The wheel.
    pub wheel: Wheel<f64>,
    /// Its loads, N.
    pub load_n: Range,
}

/// A trained network.
#[derive(Debug, Clone, PartialEq)]
pub struct CrossNetwork {
    inputs: Scale<INPUTS>,
    targets: Scale<TARGETS>,
    network: Network,
    /// Root mean square error of each target where it was tested, in the targets' units.
    error: [f64; TARGETS],
}

impl Scope {
    /// Kapvik's assumed wheel under 30–110 N.
    pub const KAPVIK: Self = Self { wheel: KAPVIK_WHEEL, load_n: Range { low: 30.0, high: 110.0, logarithmic: false } };

    /// Some wheel under loads from a little below the least to a little above the greatest that it is to be asked about.
    pub fn around(wheel: Wheel<f64>, least_load_n: f64, greatest_load_n: f64) -> Self {
        let load_n = Range { low: 0.8 * least_load_n, high: 1.25 * greatest_load_n, logarithmic: false };
        Self { wheel, load_n }
    }
}
