//! A rocker-bogie that drives over uneven sand: what its sensors say, and what is true.
//!
//! The rover is a body with all the mass on massless links, in three dimensions. Heading and sideways motion are held, so
//! seven coordinates are left, and seven balances of force and moment; they are solved at each step for the rates of the
//! coordinates, with the wheels' forces from equations 1–11. A frame whose bodies a second computation finds out of balance by
//! more than 1e-6 N or N·m is an error.

pub mod audit;
pub mod balance;
mod course;
pub mod effects;
pub mod faults;
pub mod ground_soils;
mod newton;
pub mod pose;
pub mod programme;
mod scenario;
mod sensors;
mod stepper;
pub mod terrain;
mod traverse;
pub mod wheel_soil;

pub use scenario::Scenario;
pub use traverse::{BALANCE, Options, RATE_HZ, SimulationError, Traverse};
