//! What is published of a wheel at each frame.

use serde::{Deserialize, Serialize};

use crate::rover::PerAxle;

/// A quantity and how far it may be off.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Estimate {
    /// Its value.
    pub value: f32,
    /// One standard deviation.
    pub std: f32,
}

/// What a wheel does, which decides what can be known of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum WheelActivity {
    /// Neither its rim nor its hub moves: slip is undefined, and what is known of the contact stays as it was.
    #[default]
    Standing,
    /// It turns, or is dragged while it turns slower than it travels.
    Rolling,
    /// It is dragged and does not turn: its slip is −1.
    Blocked,
    /// It bears no load that its cell can tell from none: slip and torque are the wheel's, but not the soil's.
    Lifted,
}

/// Forces and motion of one wheel.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct WheelEstimate {
    /// What the wheel does.
    pub activity: WheelActivity,
    /// Slip i, −1 … 1; none where neither rim nor hub moves.
    pub slip: Option<Estimate>,
    /// The part of the slip's standard deviation that the camera causes: common to all wheels, with the same sign.
    pub shared_slip_std: f32,
    /// Resistive torque T, N·m.
    pub resistive_torque_nm: Estimate,
    /// Contact angle: the terrain's slope under the hub, rad against the horizontal, positive uphill.
    pub contact_angle_rad: Estimate,
    /// Normal load W, N.
    pub normal_load_n: Estimate,
    /// Drawbar pull DP, N. That of a bogie's two wheels is split by their torques; the errors of the split are equal and
    /// opposite, see `split_std_n`.
    pub drawbar_pull_n: Estimate,
    /// The part of the drawbar pull's standard deviation that is the split's: shared with the other wheel of the bogie
    /// with the opposite sign; 0 for a front wheel, N.
    pub split_std_n: f32,
    /// Drawbar pull by the seed's rule, the bogie's sum shared in proportion to load, N; a front wheel's own.
    pub drawbar_pull_by_load_n: f32,
}

impl WheelEstimate {
    /// What of the torque moves the soil and not the rover, T/r − DP, N.
    pub fn resistance_n(&self, radius_m: f32) -> f32 {
        self.resistive_torque_nm.value / radius_m - self.drawbar_pull_n.value
    }
}

/// Forces and motion of one side.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SideEstimate {
    /// Its wheels.
    pub wheels: PerAxle<WheelEstimate>,
    /// Drawbar pull of the bogie's two wheels together, N: what of theirs is observable.
    pub bogie_drawbar_pull_n: Estimate,
}
