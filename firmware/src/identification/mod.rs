//! The soil from wheel states by the methods of the literature, beside the networks: each as its paper has it, all with the
//! same input and the same kind of answer, so that they can be set side by side.
//!
//! A method is a function of the wheel, of what was observed of it, and of what the method assumes. It needs no allocator,
//! ends after a bounded number of steps, and refuses for a reason that it names.

mod closed_form;
pub mod ding;
mod estimate;
pub mod hutangkabodee;
pub mod iagnemma;
mod least_squares;
pub mod map;
mod observation;
mod prior;
pub mod ray;
mod singular_values;
mod strength_told;
pub mod trial;

pub use closed_form::{StressShape, TriangularStress};
pub use estimate::{Assumed, Identified, Origin, Refusal, Told};
pub use least_squares::Bounds;
pub use observation::Observation;
pub use prior::{Belief, SoilPrior};
