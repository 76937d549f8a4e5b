//! How contact angles and links move a side, and what the sensors see of it.

use crate::rover::{PerAxle, RollingMotion, RollingSide, RollingState};
use crate::scalar::Scalar;

/// States: κ, γ front, γ middle, γ rear, pitch of rocker, bogie and body.
pub const STATES: usize = 7;
/// Measurements: velocity of the axis forward and up, rocker against body, bogie against rocker, pitch of the body.
pub const MEASUREMENTS: usize = 5;

/// The process model: how the state changes by itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactAngleModel<S> {
    /// The side's shape.
    pub side: RollingSide<S>,
    /// Speed that a ratio of one stands for: that of the rims, m/s.
    pub rim_speed_m_s: S,
    /// Sine and cosine of the body's pitch in the plane of the side.
    pub body_pitch: (S, S),
    /// Rate of the body's pitch that the gyro tells, rad/s, nose-up.
    pub body_rate_rad_s: S,
    /// How steeply each wheel sinks below the terrain that its hub travels along, rad: by so much less than the contact angle its
    /// hub rises.
    pub sinking_rad: PerAxle<S>,
}

impl<S: Scalar> ContactAngleModel<S> {
    /// The motion that a state stands for.
    pub fn motion(&self, state: &[S; STATES]) -> RollingMotion<S> {
        let [ratio, front, middle, rear, rocker_pitch_rad, bogie_pitch_rad, _] = *state;
        let sinking = &self.sinking_rad;
        let path_angles_rad =
            PerAxle { front: front - sinking.front, middle: middle - sinking.middle, rear: rear - sinking.rear };
        self.side.motion(&RollingState {
            speed_m_s: ratio * self.rim_speed_m_s,
            contact_angles_rad: path_angles_rad,
            rocker_pitch_rad,
            bogie_pitch_rad,
        })
    }

    /// Rates of change of the state, per second.
    pub fn rates(&self, state: &[S; STATES]) -> [S; STATES] {
        let motion = self.motion(state);
        let zero = S::zero();
        [zero, zero, zero, zero, motion.rocker_rate_rad_s, motion.bogie_rate_rad_s, self.body_rate_rad_s]
    }

    /// What the sensors see of a state: velocity of the axis in the body's axes, the joints' angles, and the body's pitch.
    pub fn measure(&self, state: &[S; STATES]) -> [S; MEASUREMENTS] {
        let velocity = self.motion(state).axis_velocity_m_s.turned_back(self.body_pitch);
        let [_, _, _, _, rocker, bogie, body] = *state;
        [velocity.x, velocity.z, rocker - body, bogie - rocker, body]
    }
}
