//! Measurements, one subject a file.

pub mod closing;
pub mod diagnose;
pub mod estimators;
pub mod estimators_soil;
pub mod faults;
pub mod forward;
pub mod limit;
pub mod network;
pub mod training;
