//! The seed's estimators, section 5: slip and resistive torque of each wheel, then contact angle, normal load and
//! drawbar pull.
//!
//! What happens at the edges:
//!
//! - *Standing* ([`WheelActivity::Standing`], rim and hub below 1.5 mm/s): slip is undefined and absent; contact angles are what they
//!   were before the wheels slowed down, since nothing rolls; torque follows the drive.
//! - *Starting* and *stopping*: torque and forces may jump within a frame, so for three quarters of a second they are not held to
//!   drift, nor are the pitches of the links to rolling: load shifts to the rear wheel of the bogie, which turns as it sinks. How fast torque
//!   and forces wander is learned afresh a second later. The terrain is remembered from where the wheels stood, until the paths of the hubs
//!   tell it as well. What speeds a drive up or slows it down is no part of the moments that its link has to hold.
//! - *Turning back*: rates and speeds change sign together; slip is positive when the rim is faster than the hub, in either
//!   direction. In between the wheel stands.
//! - *Blocked* ([`WheelActivity::Blocked`], a rim at less than a twelfth of its hub's speed): slip is −1. The side's speed is taken
//!   from the median of its rims, so that one blocked wheel does not matter. It is blocked until its rim moves faster than an encoder's noise.
//! - *Spinning on the spot* (rims eight times as fast as the rover): wheels dig in and meet no other terrain, which is remembered as where
//!   they start.
//! - *Swinging* (torques that go to and fro as grousers come to bear in turn): torque follows the drive, forces are not held to drift, and
//!   what a hub's speed tells of the slip counts for less, on all of a side.
//! - *Lifted* ([`WheelActivity::Lifted`], a cell that cannot tell its load from none): load and pull are zero, as surely as the cell
//!   says. A bogie with a wheel in the air, or whose moments make forces along its links necessary that no torque knows, is held by a
//!   stop. Until it is free its moments tell nothing, and the torques tell its pulls.

mod activity;
mod attitude;
mod bogie_stop;
mod camera_error;
mod compaction;
pub mod contact_angle;
mod contact_angle_model;
mod contact_forces;
mod digging_in;
pub mod doubt;
pub mod drawbar_split;
mod drive_inertia;
mod estimate;
mod health;
pub mod hub_force;
mod hub_force_model;
mod hub_on_ground;
mod joints;
mod load_shift;
mod remembered_terrain;
mod rim_growth;
mod rim_speed;
mod roughness;
mod rover_estimator;
mod runs;
mod scalar_filter;
mod scale;
mod sensor;
mod sensor_gate;
mod side_estimate;
mod side_estimator;
mod side_frame;
mod silence;
mod since_start;
mod sinking;
pub mod slip_by_speeds;
pub mod slip_torque;
mod slip_torque_model;
mod surprise;
mod swing;
mod told_by_torque;
mod track;
mod trend;
mod troubles;
mod turn;
mod walk_rate;
mod watch;
mod wheel_frame;
mod whole_balance;

pub use activity::STANDING_M_S;
pub use attitude::pitch_rate;
pub use estimate::{Estimate, SideEstimate, WheelActivity, WheelEstimate};
pub use health::{EstimatorHealth, PerSensor, SensorHealth};
pub use rover_estimator::{GAP_US, RoverEstimator, Taken};
pub use sensor::{Axis, Sensor};
pub use sensor_gate::SensorGates;
pub use side_estimate::{Believed, WheelCovariance};
pub use side_estimator::SideInnovations;
pub use troubles::Troubles;
