//! What the flight pipeline says of a drive.

use kapvik_firmware::pipeline::{FrameEstimate, Pipeline};
use kapvik_firmware::rover::Rover;
use kapvik_firmware::sensor_frame::SensorFrame;
use kapvik_host::data::truth_file::Truth;
use kapvik_host::trial::flight_pipeline;

/// What is said of each frame, with what was true, and the pipeline after the last.
pub fn driven(
    rover: &Rover<f64>,
    frames: impl IntoIterator<Item = (SensorFrame, Truth)>,
) -> (Vec<(FrameEstimate, Truth)>, Pipeline) {
    let mut pipeline = flight_pipeline(rover).expect("a rover that can be");
    let said = frames.into_iter().map(|(frame, truth)| (*pipeline.tick(&frame), truth)).collect();
    (said, pipeline)
}
