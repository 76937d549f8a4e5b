//! Identification: cohesion, friction angle and shear modulus of each run of a campaign, with their standard deviations
//! and whether they can be told at all.
//!
//! Rows with the same run and time are the wheels of one instant, and each run is one soil. A query to the networks holds
//! six wheels at most, so what a run holds more of is averaged: see [`combine`].

pub mod combine;
pub mod condition;
mod document;
mod network;
mod sensor_noise;
pub mod soil_bank;

use clap::ValueEnum;
use kapvik_firmware::soil::QueryAnswer;
use kapvik_firmware::wheel_state::SoilQuery;

use crate::error::HostError;

pub use document::{Document, NoiseDocument, ParameterDocument, RunDocument, SoilDocument, WheelDocument};
pub use network::{Identification, IdentifiedRun, Question, assumed_soil, at_edge, identify, refusal_in_words};
pub use sensor_noise::{NoiseSource, SensorNoise};

/// A method of the literature, or ours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Method {
    /// The frozen networks that fly
    Network,
}

/// What answers a query: the flight library in this process, or the flight computer over its link.
pub type Answer<'a> = dyn FnMut(&SoilQuery) -> Result<QueryAnswer, HostError> + 'a;
