//! Measurements, one subject a file.

pub mod forward;
pub mod network;
pub mod training;
