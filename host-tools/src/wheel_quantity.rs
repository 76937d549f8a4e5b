//! The quantities of a wheel that are estimated: their names, and where they stand in an estimate and in a truth.

use kapvik_firmware::estimator::{Estimate, WheelEstimate};

use crate::data::truth_file::WheelTruth;

/// A quantity of a wheel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WheelQuantity {
    /// Slip i.
    Slip,
    /// Resistive torque T, N·m.
    ResistiveTorque,
    /// Contact angle, rad.
    ContactAngle,
    /// Normal load W, N.
    NormalLoad,
    /// Drawbar pull DP, N.
    DrawbarPull,
}

impl WheelQuantity {
    /// All, in the order of the files.
    pub const ALL: [Self; 5] =
        [Self::Slip, Self::ResistiveTorque, Self::ContactAngle, Self::NormalLoad, Self::DrawbarPull];

    /// Its name for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Slip => "slip",
            Self::ResistiveTorque => "resistive torque",
            Self::ContactAngle => "contact angle",
            Self::NormalLoad => "normal load",
            Self::DrawbarPull => "drawbar pull",
        }
    }

    /// What stands before and behind a wheel's name in the name of its column.
    pub const fn column(self) -> (&'static str, &'static str) {
        match self {
            Self::Slip => ("slip_", ""),
            Self::ResistiveTorque => ("resistive_torque_", "_nm"),
            Self::ContactAngle => ("contact_angle_", "_rad"),
            Self::NormalLoad => ("normal_load_", "_n"),
            Self::DrawbarPull => ("drawbar_pull_", "_n"),
        }
    }

    /// The unit that people are shown it in; nothing of a slip.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Slip => "",
            Self::ResistiveTorque => "N·m",
            Self::ContactAngle => "°",
            Self::NormalLoad | Self::DrawbarPull => "N",
        }
    }

    /// The unit as it stands behind a number.
    pub const fn spaced_unit(self) -> &'static str {
        match self {
            Self::Slip | Self::ContactAngle => self.unit(),
            Self::ResistiveTorque => " N·m",
            Self::NormalLoad | Self::DrawbarPull => " N",
        }
    }

    /// A value in SI units in that unit.
    pub fn shown(self, value: f64) -> f64 {
        if self == Self::ContactAngle { value.to_degrees() } else { value }
    }

    /// What is estimated; none of a slip where neither rim nor hub moves.
    pub fn estimate(self, wheel: &WheelEstimate) -> Option<Estimate> {
        match self {
            Self::Slip => wheel.slip,
            Self::ResistiveTorque => Some(wheel.resistive_torque_nm),
            Self::ContactAngle => Some(wheel.contact_angle_rad),
            Self::NormalLoad => Some(wheel.normal_load_n),
            Self::DrawbarPull => Some(wheel.drawbar_pull_n),
        }
    }

    /// What is true, not a number where a file does not tell it; none of a slip where neither rim nor hub moves.
    pub fn truth(self, wheel: &WheelTruth) -> Option<f64> {
        match self {
            Self::Slip => wheel.slip,
            Self::ResistiveTorque => Some(wheel.resistive_torque_nm),
            Self::ContactAngle => Some(wheel.contact_angle_rad),
            Self::NormalLoad => Some(wheel.normal_load_n),
            Self::DrawbarPull => Some(wheel.drawbar_pull_n),
        }
    }

    /// The estimate less the truth, in SI units; none where one of both is none.
    pub fn error(self, wheel: &WheelEstimate, truth: &WheelTruth) -> Option<f64> {
        Some(f64::from(self.estimate(wheel)?.value) - self.truth(truth)?)
    }
}
