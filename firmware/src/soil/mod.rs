//! The soil estimate: wheel states to the networks' inputs, and their outputs to cohesion, friction angle and modulus.

mod answer;
mod estimate;
mod features;

pub use answer::QueryAnswer;
pub use estimate::{ParameterEstimate, Refusal, SoilEstimate};
pub use features::{ContextFeatures, FifthInput, WheelFeatures};
