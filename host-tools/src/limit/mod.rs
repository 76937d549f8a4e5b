//! The limit that no estimator can beat: the mean of the exact posterior of a soil, given a noisy observation.
//!
//! Prior, noise and wheel–soil equations are those that the observations were drawn with, so that the posterior mean has
//! the least mean square error of all functions of the observation. One thing is left out on purpose: that the slips of the
//! cases are a fixed design, which no estimator is told. True slip has a flat prior here. Told the slips, the posterior mean
//! of a single instant comes nearer by 9 ± 3 % in φ and 7 ± 4 % in ln K (100 cases); whether the loads are known to lie
//! within ±8 % or may be anything changes 1 ± 1 %.
//!
//! From the ground up: `coordinates` of a soil, `response` of a wheel (by `dual` numbers), `wheel_likelihood`, `posterior`,
//! its `mode`, the `straight` coordinates about it, and `slice` steps of a `sampler` in those; `diagnostics`, `summary` and
//! `calibration` say what came out, `case` and `accuracy` hold it against the truth.

pub mod accuracy;
pub mod calibration;
pub mod case;
pub mod coordinates;
pub mod density;
pub mod diagnostics;
pub mod mode;
pub mod posterior;
pub mod response;
pub mod sampler;
pub mod slice;
pub mod straight;
pub mod student;
pub mod summary;
pub mod wheel_likelihood;
