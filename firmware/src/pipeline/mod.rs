//! What a board calls: sensor frames in, forces and soil out ([`Pipeline::tick`]); or wheel states in, soil out
//! ([`answer`]).

mod frame_estimate;
mod soil_query;
mod tick;

pub use frame_estimate::{FrameEstimate, RoverSoil};
pub use soil_query::answer;
pub use tick::Pipeline;
