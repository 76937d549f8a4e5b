//! What a board calls: sensor frames in, forces and soil out ([`Pipeline::tick`]); or wheel states in, soil out
//! ([`answer`]).

mod frame_estimate;
mod tick;

pub use crate::soil::answer;
pub use frame_estimate::FrameEstimate;
pub use tick::Pipeline;
