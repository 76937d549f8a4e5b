//! Training of the network that tells how far the estimators err beyond what their filters state.
//!
//! Simulated drives give frames in which estimates, stated covariances and truth are known. By maximum likelihood a small network
//! learns from them, for each quantity that is stated, by how much the standard deviation is to be multiplied. It is rounded to the
//! whole numbers that fly and written as Rust source.

pub mod drives;
pub mod emit;
pub mod held_out;
pub mod loss;
mod pass;
pub mod rows;
pub mod standardise;
pub mod training;
pub mod weights;
