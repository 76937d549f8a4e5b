//! What a drive told.

use kapvik_firmware::rover::Rover;

use super::samples::Samples;
use crate::data::assumed_keys::AssumedKeys;
use crate::replay::Outcome;
use crate::report::facts::FlightFacts;
use crate::simulate::Scenario;
use crate::trial::errors::Errors;

/// Where the frames are from.
#[derive(Debug, Clone, PartialEq)]
pub enum Origin {
    /// A file.
    Recorded(String),
    /// The simulator.
    Simulated {
        /// The kind of drive.
        scenario: Scenario,
        /// What all chance was drawn from.
        seed: u64,
    },
}

/// Everything that the report of a drive shows.
#[derive(Debug, Clone)]
pub struct TraverseFindings {
    /// Where the frames are from.
    pub origin: Origin,
    /// The rover that was calculated with.
    pub rover: Rover<f32>,
    /// What of it is assumed, and not as a file says.
    pub assumed: AssumedKeys,
    /// What is to be known of how the recording was read.
    pub remarks: Vec<String>,
    /// Estimates and truths, thinned.
    pub samples: Samples,
    /// Whether a truth is beside the frames that has a row at the time of none.
    pub truth_is_of_other_times: bool,
    /// Errors against the truth, where it is known.
    pub errors: Option<Errors>,
    /// What came of the replay.
    pub outcome: Outcome,
    /// What is told of the flight computer.
    pub flight: FlightFacts,
}

impl TraverseFindings {
    /// What the drive is called.
    pub fn name(&self) -> String {
        match &self.origin {
            Origin::Recorded(name) => name.clone(),
            Origin::Simulated { scenario, seed } => {
                format!("a simulated drive ({scenario}, seed {seed})")
            }
        }
    }
}
