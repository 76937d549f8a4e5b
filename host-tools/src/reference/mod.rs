//! References that the flight filters are held against: slow, in double precision, and by another method.

pub mod continuous_model;
pub mod kalman_bucy;
