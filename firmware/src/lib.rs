//! Soil estimation for the flight computer of a rocker-bogie rover.
//!
//! `no_std`, no allocator, no panic path. The host tools run this same library, and get the same bits.
#![cfg_attr(not(test), no_std)]

pub mod math;
pub mod network;
pub mod scalar;
pub mod soil;
pub mod terramechanics;
pub mod wheel_state;
