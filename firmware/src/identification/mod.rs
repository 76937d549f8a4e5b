//! The soil from wheel states by the methods of the literature, beside the networks: each as its paper has it, all with the
//! same input and the same kind of answer, so that they can be set side by side.
//!
//! A method is a function of the wheel, of what was observed of it, and of what the method assumes. It needs no allocator,
//! ends after a bounded number of steps, and refuses for a reason that it names.

mod estimate;
pub mod map;
mod observation;
mod prior;

pub use estimate::{Identified, Origin, Refusal, Told};
pub use observation::Observation;
pub use prior::{Belief, SoilPrior};
