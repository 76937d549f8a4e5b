//! Wheel–soil mechanics: the seed's equations 1–11, written once, generic over the scalar.

mod contact;
mod forces;
mod quadrature;
mod sinkage;
mod soil;
mod wheel;

pub use contact::Contact;
pub use forces::{ForceError, WheelForces, wheel_forces};
pub use sinkage::{SinkageError, sinkage_for_load};
pub use soil::Soil;
pub use wheel::Wheel;
