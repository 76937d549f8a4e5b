//! A square-root sigma-point (unscented) filter of fixed size whose steps cannot end in NaN.
//!
//! [`SigmaPointFilter`] estimates a state of `N` numbers from `M` measurements, any of which may be missing. It carries a
//! square root of the covariance, any one, in place of the covariance, and a step changes that by orthogonal reflections:
//! nothing is subtracted from a covariance and no covariance is inverted, so a step cannot make it indefinite, in single
//! precision either.
//!
//! A step is one of the predictions ([`SigmaPointFilter::predict`], [`SigmaPointFilter::random_walk`]) and an
//! [`SigmaPointFilter::update`]. What a measurement did to the estimate is in the [`Innovation`] that `update` returns.
//! Beside steps, [`SigmaPointFilter::take`] takes a measurement of a sum of states by Potter's factor of the root, without
//! a guard against products that overflow.
//!
//! Source: the unscented transform of Julier and Uhlmann (2004, Proc. IEEE 92:401–422) with the weights of Wan and van der
//! Merwe (2000), in differences of pairs; the measurement update is the information form of the array algorithms in
//! Kailath, Sayed and Hassibi, *Linear Estimation* (2000), chapter 12.

mod gaussian;
mod innovation;
mod prediction;
mod reflection;
mod sigma_point_filter;
mod spread;
mod transform;
pub mod trial;
mod update;
mod vector;

pub use gaussian::{Gaussian, InvalidNumber};
pub use innovation::{Fate, Fusion, Gate, Innovation, Residual};
pub use prediction::Prediction;
pub use sigma_point_filter::SigmaPointFilter;
pub use spread::Spread;
