//! Soil estimation for the flight computer of a rocker-bogie rover.
//!
//! `no_std`, no allocator, no panic path. The host tools run this same library, and get the same bits.
#![cfg_attr(not(test), no_std)]

pub mod checksum;
pub mod dual;
pub mod estimator;
pub mod filter;
pub mod fingerprint;
pub mod frozen;
pub mod fusion;
pub mod identification;
pub mod link;
pub mod math;
pub mod network;
mod outlined;
pub mod pipeline;
pub mod rover;
pub mod scalar;
pub mod self_test;
pub mod sensor_frame;
pub mod soil;
pub mod telemetry;
pub mod terramechanics;
pub mod wheel_state;
