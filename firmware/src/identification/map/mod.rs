//! Maximum a posteriori with errors in variables: every observation's true sinkage and slip are unknown too, and the
//! integrals of the wheel–soil equations are taken as they are (METHODS.md, section 7.4).
//!
//! Residuals, each over its standard deviation: drawbar pull, load, torque, slip, and the sinkage where it was measured; and
//! those of the beliefs ([`crate::identification::SoilPrior`]). Their slopes come with the equations (dual numbers); the true
//! sinkage and slip are rotated out wheel by wheel, so that the work grows in proportion to the observations. Levenberg and
//! Marquardt's steps, from three places of the prior, lead to the mode. What is told is not the mode but mean and spread of
//! the posterior about it: see [`mixture`](self).
//!
//! Braking wheels are welcome.

mod condition;
mod declared;
mod descent;
mod estimate;
mod information;
mod mixture;
mod prediction;
mod problem;
mod rows;
mod triangle;
mod unknowns;

pub use declared::{DeclaredEffects, FreeParameter};
pub use estimate::{Fitted, MapEstimate, identify, identify_declared};
pub use information::{Foreseen, information};
pub use unknowns::EFFECT_PARAMETERS;

/// Most observations.
pub const CAPACITY: usize = 24;
