//! Recorded frames through the estimators.

pub mod naive;
