//! One frame after the other.

use super::FrameEstimate;
use crate::estimator::{Estimate, EstimatorHealth, RoverEstimator, Taken};
use crate::fusion::SoilOverTime;
use crate::rover::{GeometryError, PerAxle, PerSide, PerWheel, Rover};
use crate::sensor_frame::SensorFrame;
use crate::soil::Refusal;

/// The seed's chain, whole: sensor frames to wheel forces to soil.
#[derive(Debug, Clone)]
pub struct Pipeline {
    estimator: RoverEstimator<f32>,
    soil: SoilOverTime,
    last: FrameEstimate,
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
        let wheel_soils = PerSide::both(PerAxle::all(Err(Refusal::NotRolling)));
        let last = FrameEstimate {
            time_us: 0,
            wheels: PerWheel::default(),
            bogie_drawbar_pull_n: PerSide::default(),
            wheel_soils,
            soil: Err(Refusal::NotRolling),
        };
        Ok(Self { estimator, soil: SoilOverTime::new(rover), last })
    }

    /// Takes a frame. Every number that comes out is finite, whatever comes in. A frame that repeats the time of the one
    /// before, or comes from before it, changes nothing: the estimate is that of the one before.
    pub fn tick(&mut self, frame: &SensorFrame) -> FrameEstimate {
        if let Taken::Used(travel_m) = self.estimator.tick(frame) {
            let sides = self.estimator.estimate();
            let wheels = sides.map(|side| side.wheels);
            let bogie_drawbar_pull_n = sides.map(|side| side.bogie_drawbar_pull_n);
            let pitch = Estimate { value: self.estimator.pitch_rad(), std: self.estimator.pitch_std_rad() };
            let (wheel_soils, soil) = self.soil.tick(&wheels, pitch, travel_m);
            self.last = FrameEstimate { time_us: frame.time_us, wheels, bogie_drawbar_pull_n, wheel_soils, soil };
        }
        self.last
    }

    /// What was said of the last frame; before the first, that nothing is known.
    pub fn last(&self) -> &FrameEstimate {
        &self.last
    }

    /// The filters, for whoever tests them.
    pub fn estimator(&self) -> &RoverEstimator<f32> {
        &self.estimator
    }

    /// How sensors and filters do.
    pub fn health(&self) -> &EstimatorHealth {
        self.estimator.health()
    }
}
