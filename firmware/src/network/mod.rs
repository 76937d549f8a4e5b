//! The multilayer perceptrons that map wheel states to soil: equations 12 and 13 of the seed over frozen weights.
//!
//! Nothing here knows what its inputs mean; [`crate::soil`] does. The build script compiles this folder, too, to
//! reproduce the golden pairs of a table before it is frozen in.

pub mod fixed_point;
mod golden;
mod normalisation;
mod parts;
mod posterior;
mod rover_inputs;
mod rover_network;
mod shape;
mod table;
mod wheel_network;
mod words;

pub use golden::{FLOWN_PAIRS, GOLDEN_PAIRS, RoverGolden, WheelGolden};
pub use normalisation::Normalisation;
pub use parts::PartVisitor;
pub use posterior::{IntervalFactors, KNOTS, Marginal, Posterior, PosteriorScale};
pub use rover_inputs::rover_inputs;
pub use rover_network::RoverNetwork;
pub use shape::*;
pub use table::{RoverTable, WheelTable, checksum};
pub use wheel_network::WheelNetwork;
pub use words::Words;
use words::words;

/// Lists one behind the other; what lacks at the end is zero.
pub fn joined<const N: usize, const PARTS: usize>(parts: [&[f32]; PARTS]) -> [f32; N] {
    let mut all = [0.0; N];
    let mut places = all.iter_mut();
    // Loop in loop: a chained iterator that is asked for one value after the other costs the target three times as much.
    for part in parts {
        for (value, place) in part.iter().zip(&mut places) {
            *place = *value;
        }
    }
    all
}
