//! What a row says beside slip, load and forces: what effects may follow.

use kapvik_firmware::terramechanics::effects::Conditions;

use super::{Campaign, Channel};

impl Campaign {
    /// What is known of the instant of a row.
    pub fn conditions(&self, row: usize) -> Conditions<f64> {
        let value = |channel| self.value(row, channel);
        Conditions {
            pass: value(Channel::Pass),
            temperature_c: value(Channel::Temperature),
            hours_since_zero: value(Channel::HoursSinceZero),
            speed_m_s: value(Channel::Speed),
            wheel_rate_rad_s: value(Channel::WheelRate),
            wheel_angle_rad: value(Channel::WheelAngle),
            travel_m: value(Channel::Travel),
            pitch_rad: value(Channel::Pitch),
            slip_angle_rad: value(Channel::SlipAngle),
            felt_slip: None,
        }
    }
}
