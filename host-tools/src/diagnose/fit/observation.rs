//! What was measured.

use nalgebra::{Const, Dyn, OMatrix, SMatrix, SVector};

/// Channels of a row.
pub const CHANNELS: usize = 6;

/// One number per channel.
pub(super) type Channels = SVector<f64, CHANNELS>;
/// One number per pair of channels.
pub(super) type ChannelMatrix = SMatrix<f64, CHANNELS, CHANNELS>;
/// One number per parameter and channel.
pub(super) type ParameterByChannel = OMatrix<f64, Dyn, Const<CHANNELS>>;
/// Derivative of each channel by the two latents, slip and load.
pub(super) type ByLatents = SMatrix<f64, CHANNELS, 2>;

/// A channel, in the order of every array of [`CHANNELS`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reading {
    /// Drawbar pull, N.
    DrawbarPull,
    /// Torque, N·m.
    Torque,
    /// Sinkage, m.
    Sinkage,
    /// Side force, N.
    SideForce,
    /// Slip.
    Slip,
    /// Load, N.
    Load,
}

impl Reading {
    /// All channels, in order.
    pub const ALL: [Self; CHANNELS] =
        [Self::DrawbarPull, Self::Torque, Self::Sinkage, Self::SideForce, Self::Slip, Self::Load];

    /// The channels that a prediction is judged by: slip and load are what it is made from.
    pub const JUDGED: [Self; 4] = [Self::DrawbarPull, Self::Torque, Self::Sinkage, Self::SideForce];

    /// Place in an array of channels.
    pub const fn index(self) -> usize {
        self as usize
    }
}

/// One row of a campaign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// The run that it belongs to: any number, the same for all rows of the run.
    pub run: usize,
    /// The readings in the units of [`Reading`]; none where not measured.
    pub readings: [Option<f64>; CHANNELS],
    /// One standard deviation of each reading's noise, > 0 wherever there is a reading. Where the fit estimates the noise of
    /// a channel these are relative weights, and a first guess.
    pub noise: [f64; CHANNELS],
}

impl Row {
    /// Whether every reading is finite and has a finite positive noise.
    pub(super) fn is_sound(&self) -> bool {
        let sound = |(reading, noise): (&Option<f64>, &f64)| {
            reading.is_none_or(|reading| reading.is_finite() && noise.is_finite() && *noise > 0.0)
        };
        self.readings.iter().zip(&self.noise).all(sound)
    }
}
