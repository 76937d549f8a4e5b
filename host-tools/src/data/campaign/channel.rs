//! The columns that the format names.

use kapvik_firmware::terramechanics::effects::Column;

/// A column of a campaign that means one thing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Channel {
    /// Time within the run, s.
    Time,
    /// Slip i, −1 … 1.
    Slip,
    /// Normal load W, N.
    Load,
    /// Drawbar pull DP, N.
    DrawbarPull,
    /// Resistive torque T, N·m.
    Torque,
    /// Sinkage z, m.
    Sinkage,
    /// Side force, N.
    SideForce,
    /// Slip angle, rad.
    SlipAngle,
    /// Rate of the wheel, rad/s.
    WheelRate,
    /// Speed of the hub along the ground, m/s.
    Speed,
    /// Angle of the wheel, rad.
    WheelAngle,
    /// Which pass over the same ground, from 1.
    Pass,
    /// Temperature, °C.
    Temperature,
    /// Time since the force sensors were zeroed, h.
    HoursSinceZero,
    /// Way travelled, m.
    Travel,
    /// Pitch of the rig or rover, rad.
    Pitch,
}

impl Channel {
    /// All of them.
    pub const ALL: [Self; 16] = [
        Self::Time,
        Self::Slip,
        Self::Load,
        Self::DrawbarPull,
        Self::Torque,
        Self::Sinkage,
        Self::SideForce,
        Self::SlipAngle,
        Self::WheelRate,
        Self::Speed,
        Self::WheelAngle,
        Self::Pass,
        Self::Temperature,
        Self::HoursSinceZero,
        Self::Travel,
        Self::Pitch,
    ];

    /// The name of the column; it ends with the unit.
    pub fn name(self) -> &'static str {
        match self {
            Self::Time => "t_s",
            Self::Slip => "slip",
            Self::Load => "load_n",
            Self::DrawbarPull => "drawbar_pull_n",
            Self::Torque => "torque_nm",
            Self::Sinkage => "sinkage_m",
            Self::SideForce => "side_force_n",
            Self::SlipAngle => "slip_angle_rad",
            Self::WheelRate => "wheel_rate_rad_s",
            Self::Speed => "speed_m_s",
            Self::WheelAngle => "wheel_angle_rad",
            Self::Pass => "pass",
            Self::Temperature => "temperature_c",
            Self::HoursSinceZero => "hours_since_zero",
            Self::Travel => "travel_m",
            Self::Pitch => "pitch_rad",
        }
    }

    /// The channel of that column.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|channel| channel.name() == name)
    }

    /// The channel that a column of an effect's form is read from; none of what is a property of the wheel.
    pub fn read_from(column: Column) -> Option<Self> {
        Some(match column {
            Column::DrawbarPull => Self::DrawbarPull,
            Column::Load => Self::Load,
            Column::Torque => Self::Torque,
            Column::Sinkage => Self::Sinkage,
            Column::SideForce => Self::SideForce,
            Column::SlipAngle => Self::SlipAngle,
            Column::WheelRate => Self::WheelRate,
            Column::Speed => Self::Speed,
            Column::WheelAngle => Self::WheelAngle,
            Column::Pass => Self::Pass,
            Column::Temperature => Self::Temperature,
            Column::HoursSinceZero => Self::HoursSinceZero,
            Column::Travel => Self::Travel,
            Column::Pitch => Self::Pitch,
            Column::Grousers => return None,
        })
    }

    /// Refuses numbers that the channel cannot have; says what was expected.
    pub(super) fn check(self, number: f64) -> Result<(), &'static str> {
        match self {
            Self::Slip if !(-1.0..=1.0).contains(&number) => Err("a slip from −1 to 1"),
            Self::SlipAngle | Self::Pitch if number.abs() > std::f64::consts::PI => Err("an angle in rad"),
            _ => Ok(()),
        }
    }
}
