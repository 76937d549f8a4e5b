//! Maximum a posteriori with errors in variables: every observation's true sinkage and slip are unknown too, and the
//! integrals of the wheel–soil equations are taken as they are.
//!
//! Residuals, each over its standard deviation: load and slip, and drawbar pull, torque and sinkage where these were
//! measured (one of the first two was); and those of the beliefs ([`crate::identification::SoilPrior`]). Their slopes come
//! with the equations (dual numbers); the true sinkage and slip are rotated out wheel by wheel, so that the work grows in
//! proportion to the observations. Levenberg and Marquardt's steps, from three places of the prior, lead to the mode; the
//! noise is first taken sixteen and four times as great, because the floor of the valley is bent and the narrower it is the
//! longer the way along it. Where that ends beyond chance, the same places on stiffer and softer soil are tried, too.
//!
//! What is told is not the mode but mean and spread of the posterior about it, because the posterior of a small cohesion has
//! one long end: normal distributions are mixed along ln c, and along ln K and φ where they are not known well. The mode is given
//! beside them.
//!
//! Flat beliefs of sinkage and slip are beliefs in slip and load, which do not depend on the soil. η is held at the mean of
//! its belief; a rear contact that is to be fitted is an effect. Braking wheels are welcome.
//!
//! From the ground up: `unknowns` and their beliefs, `prediction` of the readings
//! (`by_seed`, `with_effects`), `rows` of one observation, the `problem` as a whole, `descent` to the `mode`, the `normal`
//! distribution about a fit, `mixture` of these about the mode, `estimate`.

mod by_seed;
mod condition;
mod declared;
mod descent;
mod estimate;
mod information;
mod mixture;
mod mode;
mod normal;
mod prediction;
mod problem;
mod rows;
mod unknowns;
mod with_effects;

pub use declared::{DeclaredEffects, FreeParameter};
pub use estimate::{Fitted, MapEstimate, identify, identify_declared, identify_up_to};
pub use information::{Foreseen, information};
pub use unknowns::EFFECT_PARAMETERS;

/// Most observations, where none are stated.
pub const CAPACITY: usize = 24;
