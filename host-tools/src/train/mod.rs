//! Training of the networks on the ground: stated priors, wheel–soil theory, sensor noise, three trainers, one table.

pub mod back_propagation;
pub mod calibration;
pub mod comparison;
pub mod cross;
pub mod curve;
pub mod dataset;
mod drive;
pub mod emit;
pub mod epochs;
pub mod example;
pub mod extended_kalman;
pub mod fifth_input;
pub mod levenberg_marquardt;
pub mod loss;
pub mod observe;
pub mod plan;
pub mod prior;
pub mod progress;
mod rank_update;
pub mod rover_training;
pub mod scene;
pub mod score;
pub mod trainable;
pub mod wheel_training;
pub mod world;
