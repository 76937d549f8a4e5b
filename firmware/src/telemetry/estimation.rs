//! The pipeline behind the link: each frame goes through it once, in order, however often it is sent.

use super::noticed::{Noticed, Watch};
use crate::estimator::EstimatorHealth;
use crate::link::{FrameRefusal, RoverSource, next_sequence};
use crate::pipeline::{FrameEstimate, Pipeline};
use crate::rover::{GeometryError, Rover};
use crate::sensor_frame::SensorFrame;

/// A pipeline for one rover, and what it said last.
#[derive(Debug)]
pub(super) struct Estimation {
    pipeline: Pipeline,
    source: RoverSource,
    watch: Watch,
    last: Option<Answered>,
}

/// The answer to the last frame, kept in case its reply was lost.
#[derive(Debug)]
struct Answered {
    sequence: u16,
    estimate: FrameEstimate,
}

impl Estimation {
    /// A pipeline for a rover.
    ///
    /// # Errors
    /// Where there can be no such rover.
    pub fn new(rover: &Rover<f32>, source: RoverSource) -> Result<Self, GeometryError> {
        Ok(Self { pipeline: Pipeline::new(rover)?, source, watch: Watch::default(), last: None })
    }

    /// Where the rover's dimensions are from.
    pub fn source(&self) -> RoverSource {
        self.source
    }

    /// How sensors and filters do.
    pub fn health(&self) -> &EstimatorHealth {
        self.pipeline.health()
    }

    /// The numbers of requests start anew: no frame can be the last one sent again.
    pub fn forget_numbers(&mut self) {
        self.last = None;
    }

    /// The estimate of a frame that came with `sequence` where the request before it had `last_served`, and what was
    /// noticed; nothing is where the frame was there before, and its answer is the same again.
    ///
    /// # Errors
    /// Where it is neither the last frame again nor the next one.
    pub fn take(
        &mut self,
        frame: &SensorFrame,
        sequence: u16,
        last_served: u16,
    ) -> Result<(FrameEstimate, Option<Noticed>), FrameRefusal> {
        let expected = next_sequence(last_served);
        match &self.last {
            Some(last) if last.sequence == sequence => Ok((last.estimate, None)),
            _ if sequence == expected => {
                let estimate = self.pipeline.tick(frame);
                self.last = Some(Answered { sequence, estimate });
                Ok((estimate, Some(self.watch.notice(self.pipeline.health(), &estimate))))
            }
            _ => Err(FrameRefusal::OutOfOrder { expected }),
        }
    }
}
