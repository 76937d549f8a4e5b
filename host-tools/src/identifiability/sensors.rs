//! How noisy the sensors are, and what of their errors no averaging removes.

use serde::Serialize;

/// Independent instants of [`KAPVIK_INSTANT_NOISE`](crate::prior::KAPVIK_INSTANT_NOISE) in a second.
///
/// Measured on simulated drives (eight of 150 s at 20 frames a second for each kind of ground, through the flight filters):
/// on level ground the errors of slip, torque, load and drawbar pull are 0.0034, 0.007 N·m, 0.066 N and 0.16 N, and an
/// independent one comes every 4.5, 3.7, 3.3 and 4.9 s (integral of their autocorrelation). A second's worth is 0.0075,
/// 0.014 N·m, 0.13 N and 0.37 N: what the sensors' white noise leaves of 20 frames. Slip, the least known in units of
/// such an instant, gives 1.8 instants a second and drawbar pull 1.8; one is what is counted on. On hilly ground it is
/// 0.1 and 0.05.
pub const INSTANTS_PER_SECOND: f64 = 1.0;

/// Frames a second that a drive is planned with, as the instants above were measured; drives of the simulator have ten unless others are
/// asked for.
pub const FRAMES_PER_SECOND: f64 = 20.0;

/// One standard deviation of each error that lasts, so that it does not average away.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LastingErrors {
    /// Of the velocimeter's scale, common to all wheels: κ of δi = −κ(1 − |i|).
    pub speed_scale: f64,
    /// Of a load cell, N.
    pub load_n: f64,
    /// Of a drive's torque, N·m.
    pub torque_nm: f64,
    /// Of a single wheel's drawbar pull where it is not computed from the rover's balance, N.
    pub drawbar_pull_n: f64,
    /// Of the pitch, rad.
    pub pitch_rad: f64,
}

impl LastingErrors {
    /// None at all.
    pub const NONE: Self = Self { speed_scale: 0.0, load_n: 0.0, torque_nm: 0.0, drawbar_pull_n: 0.0, pitch_rad: 0.0 };
}

/// What is assumed of the pitch's, degrees.
pub const LASTING_PITCH_DEG: f64 = 0.2;

impl Default for LastingErrors {
    /// Assumed: what a calibration before the drive leaves. The drawbar pull's is a sixth of what the pitch's does to the
    /// weight of the assumed rover.
    fn default() -> Self {
        Self {
            speed_scale: 0.005,
            load_n: 0.3,
            torque_nm: 0.02,
            drawbar_pull_n: 0.25,
            pitch_rad: LASTING_PITCH_DEG.to_radians(),
        }
    }
}
