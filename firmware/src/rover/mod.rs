//! Geometry, kinematics and statics of a rocker-bogie: front wheels on the rockers, middle and rear wheels on the
//! bogies, the rockers joined to the body by a differential.
//!
//! Signs are the project's: x forward, y left, z up; every pitch-like angle is positive nose-up. The links of a side move
//! in the plane of that side, x and z of the body, so that positions and forces there are [`Planar`].

mod axes;
mod geometry;
mod kinematics;
mod planar;
mod rolling;
mod sensor_noise;
mod sides;
mod statics;

pub use axes::Axes;
pub use geometry::{Drive, GeometryError, Rover, Suspension};
pub use kinematics::{BodyMotion, Link, LinkAngles, SideLayout};
pub use planar::Planar;
pub use rolling::{RollingMotion, RollingSide, RollingState, hub_speed_slopes};
pub use sensor_noise::SensorNoise;
pub use sides::{Axle, PerAxle, PerSide, PerWheel, Side};
pub use statics::{HubContact, body_moment_nm, bogie_moment_nm, rocker_moment_nm};
