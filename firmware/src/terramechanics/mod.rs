//! Wheel–soil mechanics: the seed's equations 1–11, written once, generic over the scalar, and the effects they lack.

mod bracketing;
mod contact;
pub mod effects;
mod forces;
mod integral_slopes;
mod integrals;
mod normal_stress;
mod panels;
mod point_slopes;
mod quadrature;
mod rim;
mod shear_displacement;
mod shear_law;
mod shear_stress;
mod sinkage;
mod soil;
mod wheel;
mod wheel_on_soil;

pub use contact::Contact;
pub use forces::{ForceError, WheelForces, wheel_forces, wheel_forces_by};
pub use quadrature::Quadrature;
pub use sinkage::{GreatestLoad, SinkageError, deepest_sinkage, greatest_load, sinkage_for_load};
pub use soil::Soil;
pub use wheel::Wheel;
pub use wheel_on_soil::{Memory, Readings, WheelOnSoil, WheelTruth};

pub(crate) use contact::rim_angle;
pub(crate) use rim::Rim;
pub(crate) use shear_displacement::ShearDisplacement;
pub(crate) use soil::angle_of_tangent;
