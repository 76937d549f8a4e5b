//! Wheel–soil mechanics: the seed's equations 1–11, written once, generic over the scalar.

mod bracketing;
mod contact;
mod forces;
mod normal_stress;
mod panels;
mod quadrature;
mod rim;
mod shear_displacement;
mod shear_stress;
mod sinkage;
mod soil;
mod wheel;

pub use contact::Contact;
pub use forces::{ForceError, WheelForces, wheel_forces, wheel_forces_by};
pub use quadrature::Quadrature;
pub use sinkage::{GreatestLoad, SinkageError, deepest_sinkage, greatest_load, sinkage_for_load};
pub use soil::Soil;
pub use wheel::Wheel;
