//! The seed's estimators, section 5: slip and resistive torque of each wheel, then contact angle, normal load and
//! drawbar pull.

mod estimate;
mod health;

pub use estimate::{Estimate, WheelActivity, WheelEstimate};
pub use health::{EstimatorHealth, PerSensor, SensorHealth};
