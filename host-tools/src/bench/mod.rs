//! Measurements of speed, one subject a file.

pub mod forward;
