//! The seed's estimators, section 5: slip and resistive torque of each wheel, then contact angle, normal load and
//! drawbar pull.

mod attitude;
pub mod contact_angle;
pub mod drawbar_split;
mod estimate;
mod health;
pub mod hub_force;
mod rover_estimator;
mod scalar_filter;
mod sensor;
mod sensor_gate;
mod side_estimate;
mod side_estimator;
pub mod slip_torque;
mod surprise;
mod walk_rate;
mod watch;

pub use estimate::{Estimate, SideEstimate, WheelActivity, WheelEstimate};
pub use health::{EstimatorHealth, PerSensor, SensorHealth};
pub use rover_estimator::{RoverEstimator, Taken};
pub use sensor::{Axis, Sensor};
pub use side_estimate::WheelCovariance;
pub use side_estimator::SideInnovations;
