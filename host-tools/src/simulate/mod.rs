//! A rocker-bogie that drives over uneven sand: what its sensors say, and what is true.
//!
//! The rover is a body with all the mass on massless links, in three dimensions. Heading and sideways motion are held, so
//! seven coordinates are left, and seven balances of force and moment; they are solved at each step for the rates of the
//! coordinates, with the wheels' forces from equations 1–11. A frame whose bodies a second computation finds out of balance by
//! more than 1e-6 N or N·m is an error.
//!
//! What the conventions leave open is settled so:
//!
//! - The ground rises along x and is level across, for each side by itself. A wheel's tangent is where the ground's tangent plane
//!   under its hub cuts the wheel's plane; the contact angle is that tangent's slope against the horizontal, which on a
//!   rolled rover differs from the ground's own slope by less than two thousandths of itself. Sinkage is the radius less the
//!   hub's distance from that plane along the normal in the wheel's plane.
//! - Normal load and drawbar pull act through the hub, side force on the rim where the normal meets it. The side forces that
//!   hold heading and sideways motion are shared in proportion to load times a straight line along the rover.
//! - The accelerometer sits at the centre of mass.
//! - A wheel that backs up is the mirror image of one that drives ahead: slip is positive when it drives in its own direction,
//!   pull and torque change their sign. A wheel below 0.1 mm/s stands: it has no slip.
//! - Effects that follow the slip by digging follow it over a way: see [`Motion::felt_slip`](balance::Motion::felt_slip).
//! - Soil takes effect where a hub is: the two soils of a border mix over 5 cm.

pub mod audit;
pub mod balance;
mod course;
pub mod effects;
pub mod faults;
mod felt_slip;
pub mod ground_soils;
mod newton;
pub mod pose;
pub mod programme;
mod scenario;
mod sensors;
mod sliding;
mod standing;
mod stepper;
pub mod terrain;
mod traverse;
mod varied_ground;
pub mod wheel_soil;

pub use scenario::Scenario;
pub use traverse::{BALANCE, Options, RATE_HZ, SimulationError, Traverse, frame_time_us};
