//! The raw sensors' readings as numbers, and where their angles put the links.

use kapvik_firmware::rover::{Link, LinkAngles, PerAxle, PerSide, PerWheel};
use kapvik_firmware::sensor_frame::SensorFrame;

/// Slower than this a rover does not drive, m/s.
pub const DRIVING_M_S: f64 = 0.005;

/// Fewest readings, or frames, that tell what a sensor is like, and the share of them that has to say the same.
pub const LEAST_READINGS: u32 = 50;
pub const NEARLY_ALL: f64 = 0.9;

/// The fewest of six wheels that turn where a rover drives.
const LEAST_TURNING_WHEELS: usize = 4;

/// Longer than this no frame lasts, s.
pub const LONGEST_FRAME_S: f64 = 1.0;

/// How long frames last, one after the other.
#[derive(Debug, Clone, Copy)]
pub struct Steps {
    before_us: Option<u64>,
    longest_s: f64,
}

impl Default for Steps {
    fn default() -> Self {
        Self::up_to(LONGEST_FRAME_S)
    }
}

impl Steps {
    /// Steps, of which those that are longer, s, count as missing frames.
    pub fn up_to(longest_s: f64) -> Self {
        Self { before_us: None, longest_s }
    }

    /// Time since the frame before, s; none of the first, and where frames are missing or out of order.
    pub fn since_before_s(&mut self, frame: &SensorFrame) -> Option<f64> {
        let before_us = self.before_us.replace(frame.time_us)?;
        let step_s = 1e-6 * frame.time_us.checked_sub(before_us)? as f64;
        (step_s <= self.longest_s).then_some(step_s)
    }
}

/// A reading that is a number.
pub fn wide(reading: Option<f32>) -> Option<f64> {
    reading.map(f64::from).filter(|number| number.is_finite())
}

/// Whether a rover on wheels of this radius, m, drives, by the velocimeter or by most of the encoders: either of them may be dead.
pub fn drives(frame: &SensorFrame, radius_m: f64) -> bool {
    let moves = |speed_m_s: f64| speed_m_s.abs() > DRIVING_M_S;
    let turns = |rate_rad_s: f64| moves(radius_m * rate_rad_s);
    let turning = frame.wheels.iter_wheels().filter(|wheel| wide(wheel.rate_rad_s).is_some_and(turns)).count();
    turning >= LEAST_TURNING_WHEELS || wide(frame.velocity_m_s.x).is_some_and(moves)
}

/// Angles of the rockers against the body, rad: what one goes up, the other goes down.
pub fn rockers(frame: &SensorFrame) -> PerSide<Option<f64>> {
    let left = wide(frame.rocker_angle_rad);
    PerSide { left, right: left.map(|angle| -angle) }
}

/// Angle of the link that carries each wheel, rad: that of the rocker for the front wheels, of the bogie on it for the others;
/// against whatever the rockers' angles are.
pub fn links(frame: &SensorFrame, rockers: PerSide<Option<f64>>) -> PerWheel<Option<f64>> {
    rockers.zip(frame.bogie_angle_rad).map(|(rocker, bogie)| {
        let bogie = rocker.zip(wide(bogie)).map(|(rocker, bogie)| rocker + bogie);
        PerAxle { front: rocker, middle: bogie, rear: bogie }
    })
}

/// Joints that stand at these angles, rad.
pub fn links_at(rocker_rad: f64, bogie_rad: f64) -> LinkAngles<f64> {
    let still = |pitch_rad| Link { pitch_rad, rate_rad_s: 0.0 };
    LinkAngles { rocker: still(rocker_rad), bogie: still(bogie_rad) }
}
