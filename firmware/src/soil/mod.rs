//! The soil estimate: wheel states to the networks' inputs, and their outputs to cohesion, friction angle and modulus.

mod answer;
mod estimate;
mod features;
mod query;
mod solve;
pub mod trend;
pub mod trend_prior;

pub use answer::QueryAnswer;
pub use estimate::{ParameterEstimate, Refusal, SoilEstimate};
pub use features::{FifthInput, RoverContext, WheelFeatures};
pub use query::{LEAST_SLIP, answer, is_known_slip};
pub(crate) use query::{rover_outputs, wheel_soil};
