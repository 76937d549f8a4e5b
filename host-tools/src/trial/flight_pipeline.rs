//! The estimators of the flight software, for a rover as the simulator has it.

use kapvik_firmware::pipeline::Pipeline;
use kapvik_firmware::rover::Rover;

use crate::data::rover_fault::geometry_in_words;

/// The pipeline of a rover before its first frame.
///
/// # Errors
/// Says why the rover cannot be.
pub fn flight_pipeline(rover: &Rover<f64>) -> Result<Pipeline, String> {
    Pipeline::new(&rover.map(|value| value as f32)).map_err(|error| geometry_in_words(error).to_owned())
}
