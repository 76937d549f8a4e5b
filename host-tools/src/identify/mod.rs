//! Identification: cohesion, friction angle and shear modulus of each run of a campaign, with their standard deviations
//! and whether they can be told at all.
//!
//! Rows with the same run and time are the wheels of one instant, and each run is one soil. A query to the networks holds
//! six wheels at most, so what a run holds more of is averaged: see [`combine`].

mod bend;
mod beside_map;
mod beyond_training;
pub mod combine;
pub mod condition;
mod document;
mod each_run;
mod followed;
mod ignored_effects;
mod layout;
mod logarithmic;
mod memory;
pub mod method;
mod misfit;
mod network;
mod on_curve;
mod rehearsal;
mod run_states;
mod selection;
mod sensor_noise;
pub mod soil_bank;
mod soil_document;
mod spread;
mod target;

use kapvik_firmware::soil::QueryAnswer;
use kapvik_firmware::wheel_state::SoilQuery;

use crate::error::HostError;

pub use document::{Document, NoiseDocument, RunDocument, WheelDocument};
pub use each_run::{identify_beside, identify_by};
pub use method::{Method, network_refusal};
pub use network::{
    Identification, IdentifiedRun, OUTSIDE, Question, assumed_soil, at_edge, identify, identify_rehearsed,
};
pub use rehearsal::Missing;
pub use run_states::RunStates;
pub use sensor_noise::{NoiseSource, SensorNoise};
pub use soil_document::{ParameterDocument, SoilDocument};

/// What answers a query: the flight library in this process, or the flight computer over its link.
pub type Answer<'a> = dyn FnMut(&SoilQuery) -> Result<QueryAnswer, HostError> + 'a;
