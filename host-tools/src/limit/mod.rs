//! The limit that no estimator can beat: the mean of the exact posterior of a soil, given a noisy observation.
//!
//! Prior, noise and wheel–soil equations are those that the observations were drawn with, so that the posterior mean has
//! the least mean square error of all functions of the observation.

pub mod accuracy;
pub mod calibration;
pub mod case;
pub mod coordinates;
pub mod density;
pub mod diagnostics;
pub mod dual;
pub mod mode;
pub mod posterior;
pub mod response;
pub mod sampler;
pub mod slice;
pub mod straight;
pub mod student;
pub mod summary;
pub mod wheel_likelihood;
