//! Measurements, one subject a file.

pub mod network;
pub mod training;
