//! Training of the networks on the ground: stated priors, wheel–soil theory, sensor noise, three trainers, one table.

pub mod back_propagation;
pub mod dataset;
pub mod example;
pub mod extended_kalman;
pub mod fifth_input;
pub mod levenberg_marquardt;
pub mod loss;
pub mod observe;
pub mod prior;
mod rank_update;
pub mod scene;
pub mod trainable;
