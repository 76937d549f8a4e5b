//! What a row is about: the wheel's state, and the setting in which it was measured.

use crate::data::campaign::Channel;

/// The channels in which a wheel's state is measured, in the order of [`State::channels`].
pub const MEASURED: [Channel; 6] =
    [Channel::DrawbarPull, Channel::Torque, Channel::Sinkage, Channel::SideForce, Channel::Slip, Channel::Load];
/// Place of the slip in [`MEASURED`].
pub const SLIP: usize = 4;
/// Place of the load in [`MEASURED`].
pub const LOAD: usize = 5;

/// The state of a wheel, true or as sensors without noise would show it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct State {
    /// Drawbar pull, N.
    pub drawbar_pull_n: f64,
    /// Resistive torque, N·m.
    pub torque_nm: f64,
    /// Sinkage, m.
    pub sinkage_m: f64,
    /// Side force, N.
    pub side_force_n: f64,
    /// Slip.
    pub slip: f64,
    /// Normal load, N.
    pub load_n: f64,
}

impl State {
    /// All of it, in the order of [`MEASURED`].
    pub fn channels(&self) -> [f64; 6] {
        [self.drawbar_pull_n, self.torque_nm, self.sinkage_m, self.side_force_n, self.slip, self.load_n]
    }
}

/// What surrounds a row, whether the campaign has a column for it or not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    /// Which pass over the same ground, from 1.
    pub pass: f64,
    /// Temperature, °C.
    pub temperature_c: f64,
    /// Time since the force sensors were zeroed, h.
    pub hours_since_zero: f64,
    /// Rate of the wheel, rad/s.
    pub wheel_rate_rad_s: f64,
    /// Speed of the hub, m/s.
    pub speed_m_s: f64,
    /// Angle of the wheel since the run began, rad.
    pub wheel_angle_rad: f64,
    /// Way since the run began, m.
    pub travel_m: f64,
    /// Pitch of the rig, rad.
    pub pitch_rad: f64,
    /// Slip angle, rad.
    pub slip_angle_rad: f64,
    /// A column that the format does not name.
    pub other: f64,
}

/// One row as it is planned: what is asked of the wheel.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Which run, from 0.
    pub run: usize,
    /// Time within the run, s.
    pub t_s: f64,
    /// True slip.
    pub slip: f64,
    /// True load, N.
    pub load_n: f64,
    /// What surrounds it.
    pub setting: Setting,
}
