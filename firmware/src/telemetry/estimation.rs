//! The pipeline behind the link: each frame goes through it once, in order, however often it is sent.

use super::noticed::{Noticed, Watch};
use crate::estimator::EstimatorHealth;
use crate::link::{FrameRefusal, RoverSource, next_sequence};
use crate::pipeline::{FrameEstimate, Pipeline};
use crate::rover::{GeometryError, Rover};
use crate::sensor_frame::SensorFrame;

/// A pipeline for one rover, and which frame it took last.
#[derive(Debug)]
pub(super) struct Estimation {
    pipeline: Pipeline,
    source: RoverSource,
    watch: Watch,
    last_sequence: Option<u16>,
}

impl Estimation {
    /// A pipeline that takes no frame until [`Self::restart`].
    pub fn not_begun(rover: &Rover<f32>, source: RoverSource) -> Self {
        Self { pipeline: Pipeline::not_begun(rover), source, watch: Watch::default(), last_sequence: None }
    }

    /// Starts anew, for another rover, where this pipeline is.
    ///
    /// # Errors
    /// Where there can be no such rover. Then nothing has changed.
    pub fn restart(&mut self, rover: &Rover<f32>, source: RoverSource) -> Result<(), GeometryError> {
        self.pipeline.restart(rover)?;
        (self.source, self.watch, self.last_sequence) = (source, Watch::default(), None);
        Ok(())
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
        self.last_sequence = None;
    }

    /// What was said of the last frame, kept in case that reply was lost.
    pub fn last(&self) -> &FrameEstimate {
        self.pipeline.last()
    }

    /// Takes a frame that came with `sequence` where the request before it had `last_served`, and says what was noticed;
    /// nothing is where the frame was there before. The estimate is then the [last](Self::last).
    ///
    /// # Errors
    /// Where it is neither the last frame again nor the next one.
    pub fn take(
        &mut self,
        frame: &SensorFrame,
        sequence: u16,
        last_served: u16,
    ) -> Result<Option<Noticed>, FrameRefusal> {
        let expected = next_sequence(last_served);
        if self.last_sequence == Some(sequence) {
            return Ok(None);
        }
        if sequence != expected {
            return Err(FrameRefusal::OutOfOrder { expected });
        }
        self.pipeline.tick(frame);
        self.last_sequence = Some(sequence);
        Ok(Some(self.watch.notice(self.pipeline.health(), self.pipeline.last())))
    }
}
