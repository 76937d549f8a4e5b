//! One frame after the other.

use super::FrameEstimate;
use crate::estimator::{EstimatorHealth, RoverEstimator, Taken};
use crate::fusion::SoilOverTime;
use crate::rover::{GeometryError, Rover};
use crate::sensor_frame::SensorFrame;

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
        let mut pipeline = Self::not_begun(rover);
        pipeline.restart(rover)?;
        Ok(pipeline)
    }

    /// A pipeline that knows nothing of any frame until [`Self::restart`]: what is large about it is made where it stays, for two do not fit
    /// on the stack.
    pub fn not_begun(rover: &Rover<f32>) -> Self {
        Self {
            estimator: RoverEstimator::not_begun(rover),
            soil: SoilOverTime::new(rover),
            last: FrameEstimate::nothing(),
        }
    }

    /// Starts anew, for another rover, where this pipeline is.
    ///
    /// # Errors
    /// Where there can be no such rover. Then nothing has changed.
    pub fn restart(&mut self, rover: &Rover<f32>) -> Result<(), GeometryError> {
        rover.check()?;
        self.estimator.restart(rover);
        self.soil = SoilOverTime::new(rover);
        self.last = FrameEstimate::nothing();
        Ok(())
    }

    /// Takes a frame. Every number that comes out is finite, whatever comes in. A frame that repeats the time of the one
    /// before, or comes from before it, changes nothing: the estimate is that of the one before; but where several come from before,
    /// without a newer one between, the clock was set back, and the filters start anew with the last of them, as
    /// after a gap. What was known of the soil stays then: how far the rover drove meanwhile, if at all, nothing tells.
    pub fn tick(&mut self, frame: &SensorFrame) -> &FrameEstimate {
        let last = &mut self.last;
        if let Taken::Used(travel_m) = self.estimator.tick(frame) {
            let sides = self.estimator.estimate();
            last.time_us = frame.time_us;
            for (place, side) in last.wheels.as_array_mut().into_iter().zip(sides.as_array()) {
                *place = side.wheels;
            }
            last.bogie_drawbar_pull_n = sides.as_ref().map(|side| side.bogie_drawbar_pull_n);
            let backward = self.estimator.rolls_back();
            let surmises = self.estimator.surmises_contacts();
            last.soil = self.soil.tick(&last.wheels, backward, travel_m, surmises, &mut last.wheel_soils);
        }
        last
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

#[cfg(test)]
mod tests {
    use super::Pipeline;
    use crate::rover::{PerAxle, PerSide, Rover};
    use crate::sensor_frame::{SensorFrame, WheelSensors};

    fn frame(index: u16) -> SensorFrame {
        let wobble = f32::from(index % 7) - 3.0;
        let wheel = WheelSensors {
            rate_rad_s: Some(0.3 + 0.002 * wobble),
            motor_torque_nm: Some(1.4 + 0.02 * wobble),
            load_cell_n: Some(67.0 + 0.3 * wobble),
        };
        let angle = Some(0.001 * wobble);
        SensorFrame {
            time_us: 100_000 * u64::from(index),
            wheels: PerSide::both(PerAxle::all(wheel)),
            bogie_angle_rad: PerSide::both(angle),
            rocker_angle_rad: angle,
            ..SensorFrame::default()
        }
    }

    /// Encoders of wheels that stand say by their noise that these turn back as often as that they turn on.
    #[test]
    fn noise_of_encoders_is_no_turning_back() {
        let mut pipeline = Pipeline::new(&Rover::assumed()).expect("a rover");
        let mut rolls_back = |index: u16, rate_rad_s: f32| {
            let mut frame = frame(index);
            frame.wheels = frame.wheels.map_wheels(|wheel| WheelSensors { rate_rad_s: Some(rate_rad_s), ..wheel });
            pipeline.tick(&frame);
            let PerSide { left, right } = pipeline.estimator().rolls_back();
            left || right
        };
        assert!((0..50).all(|index| !rolls_back(index, 0.3 + 1.0e-4 * f32::from(index))));
        assert!((50..60).all(|index| !rolls_back(index, -4.0e-3 - 1.0e-4 * f32::from(index % 3))));
        assert!(rolls_back(60, -0.3));
    }

    /// A pipeline that starts anew for a rover must be, to the bit, one that was made for it; and one that is asked for a rover that
    /// cannot be stays as it is.
    #[test]
    fn a_pipeline_that_starts_anew_is_a_new_one() {
        let small = Rover { mass_kg: 30.0, ..Rover::<f32>::assumed() };
        let mut made = Pipeline::new(&small).expect("a rover");
        let mut restarted = Pipeline::new(&Rover::assumed()).expect("a rover");
        (0..60).for_each(|index| {
            restarted.tick(&frame(index));
        });
        let before = *restarted.last();
        let none = Rover { mass_kg: f32::NAN, ..small };
        assert!(restarted.restart(&none).is_err());
        assert_eq!(*restarted.last(), before);
        restarted.restart(&small).expect("a rover");
        for index in 0..60 {
            assert_eq!(restarted.tick(&frame(index)), made.tick(&frame(index)), "{index}");
        }
        assert_eq!(restarted.health(), made.health());
    }
}
