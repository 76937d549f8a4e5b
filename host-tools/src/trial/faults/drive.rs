//! A drive with a fault in the middle.
//!
//! It is simulated once. At the start of the fault the pipeline is copied for each case, and the copy gets the same frames
//! with the fault in them.

use kapvik_firmware::estimator::Sensor;
use kapvik_firmware::pipeline::{FrameEstimate, Pipeline};
use kapvik_firmware::rover::Rover;
use kapvik_firmware::sensor_frame::SensorFrame;

use super::case::Case;
use super::deviations::{Deviations, Excess};
use crate::data::sensor_channels::sensor_name;
use crate::data::truth_file::Truth;
use crate::error::HostError;
use crate::simulate::{Options, RATE_HZ, Scenario, Traverse};
use crate::trial::flight_pipeline;

/// When the sensors fail, s, both included.
pub const FAULT_S: (f64, f64) = (30.0, 33.0);
/// The frame after the fault, counted from one, in which every estimate must have been back.
pub const ALLOWED_FRAMES: usize = 20;
/// Frames after the fault that are looked at.
pub const WATCHED_FRAMES: usize = 50;
/// Standard deviations that a good estimate may be off by.
const LIMIT: f64 = 3.0;

/// A drive up to the fault, and the frames from there on without it.
#[derive(Debug, Clone)]
pub struct FaultDrive {
    before: Pipeline,
    last_frame: SensorFrame,
    frames: Vec<(SensorFrame, Truth)>,
    faulty_frames: usize,
    /// Without a fault, frame by frame.
    undisturbed: Vec<Deviations>,
}

/// What became of a drive with a fault.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The fault.
    pub case: Case,
    /// Frames whose estimate holds a number that is not finite.
    pub not_finite: usize,
    /// What the health does not count as it happened: columns of sensors, or frames.
    pub miscounted: Vec<String>,
    /// The frame after the fault, counted from one, in which every quantity of every wheel is within three standard deviations of the truth for
    /// the first time; where the drive without the fault is itself farther off in that frame, in which it is no farther off than that. None
    /// where no frame that is watched is so. Whether it stays back is not asked: without a fault estimates leave three standard deviations now
    /// and then, too.
    pub frames_to_recover: Option<usize>,
    /// What was farthest off when it should have been back.
    pub late: Option<Excess>,
}

impl FaultDrive {
    /// Simulates a drive.
    ///
    /// # Errors
    /// Where the simulation fails or ends too early.
    pub fn simulate(scenario: Scenario, seed: u64, rover: &Rover<f64>) -> Result<Self, HostError> {
        let failed = |why: String| scenario.failed(seed, why);
        let after_s = WATCHED_FRAMES as f64 / RATE_HZ;
        let options = Options { duration_s: Some(FAULT_S.1 + after_s), ..Options::default() };
        let traverse = Traverse::new(scenario, seed, rover, &options).map_err(|error| failed(error.to_string()))?;
        let mut before = traverse.run().map_err(|error| failed(error.to_string()))?;
        let start = before.partition_point(|(frame, _)| (frame.time_us as f64) < 1.0e6 * FAULT_S.0);
        let frames = before.split_off(start);
        let faulty_frames = frames.partition_point(|(frame, _)| frame.time_us as f64 <= 1.0e6 * FAULT_S.1);
        let mut pipeline = flight_pipeline(rover).map_err(failed)?;
        before.iter().for_each(|(frame, _)| {
            pipeline.tick(frame);
        });
        let (last_frame, _) = before.pop().ok_or_else(|| failed("no frames before the fault".to_owned()))?;
        let mut copy = pipeline.clone();
        let undisturbed = frames.iter().map(|(frame, truth)| Deviations::new(copy.tick(frame), truth)).collect();
        Ok(Self { before: pipeline, last_frame, frames, faulty_frames, undisturbed })
    }

    /// Drives on with a fault.
    ///
    /// # Errors
    /// Where there is no such fault.
    pub fn run(&self, case: Case) -> Result<Outcome, HostError> {
        let mut faults = case.faults(FAULT_S)?;
        // What a stuck sensor repeats is what it said before.
        let _ = faults.applied(&self.last_frame);
        let mut pipeline = self.before.clone();
        let (mut not_finite, mut frames_to_recover, mut late) = (0, None, None);
        for (index, ((frame, truth), undisturbed)) in self.frames.iter().zip(&self.undisturbed).enumerate() {
            let Some(frame) = faults.applied(frame) else { continue };
            let after = (index + 1).checked_sub(self.faulty_frames).filter(|after| *after > 0);
            let again = (case == Case::RepeatedFrames && after.is_none()).then_some(&frame);
            for frame in [Some(&frame), again].into_iter().flatten() {
                let estimate = *pipeline.tick(frame);
                not_finite += usize::from(!is_finite(&estimate));
                let deviations = Deviations::new(&estimate, truth);
                frames_to_recover = frames_to_recover.or(after.filter(|_| deviations.within(LIMIT, undisturbed)));
                if after == Some(ALLOWED_FRAMES) && frames_to_recover.is_none() {
                    late = deviations.worst(LIMIT, undisturbed);
                }
            }
        }
        Ok(Outcome { case, not_finite, miscounted: self.miscounted(case, &pipeline), frames_to_recover, late })
    }

    fn miscounted(&self, case: Case, pipeline: &Pipeline) -> Vec<String> {
        let frames = u16::try_from(self.faulty_frames).unwrap_or(u16::MAX);
        let (before, after) = (self.before.health(), pipeline.health());
        let sensors = before.sensors.zip_map(after.sensors, |before, after| (before, after));
        let sensors = sensors.zip_map(Sensor::all(), |(before, after), sensor| {
            (!case.counts(sensor, frames).accounts_for(&before, &after)).then(|| sensor_name(sensor))
        });
        let repeated = if case == Case::RepeatedFrames { u32::from(frames) } else { 0 };
        let frames_are_right = after.repeated_frames == before.repeated_frames + repeated
            && after.backward_frames == before.backward_frames
            && after.gaps == before.gaps;
        let frames = (!frames_are_right).then(|| "frames".to_owned());
        sensors.iter().flatten().cloned().chain(frames).collect()
    }
}

/// Whether every number of an estimate is finite: its text shows them all.
fn is_finite(estimate: &FrameEstimate) -> bool {
    let text = format!("{estimate:?}");
    !text.split(|character: char| !character.is_alphanumeric()).any(|word| word == "NaN" || word == "inf")
}
