//! The sigma-point filter against an independent Kalman filter, limits, its own statistics, and whatever can go wrong.

mod linear;
