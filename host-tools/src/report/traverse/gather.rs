//! From sensor frames to findings, by way of a flight computer.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::path::Path;

use indicatif::{ProgressBar, ProgressFinish, ProgressIterator};
use kapvik_firmware::checksum::Checksum;
use kapvik_firmware::pipeline::FrameEstimate;
use kapvik_firmware::rover::Rover;
use kapvik_firmware::sensor_frame::SensorFrame;

use super::findings::{Origin, TraverseFindings};
use super::samples::Samples;
use crate::data::assumed_keys::AssumedKeys;
use crate::data::rover_file::RoverFile;
use crate::data::truth_file::{Truth, TruthReader, truth_path};
use crate::error::HostError;
use crate::flight_computer::{Computer, FlightComputer};
use crate::qemu::LogView;
use crate::replay::naive::{TrailingMean, naive};
use crate::replay::{Recording, Remarks, replay};
use crate::report::facts::FlightFacts;
use crate::simulate::{Options, Scenario, Traverse};
use crate::trial::WARM_UP_S;
use crate::trial::errors::Errors;

/// The traverse that the project carries: this drive of the simulator.
const CARRIED: (Scenario, u64) = (Scenario::Traverse, 2);
/// [`WARM_UP_S`] as frames have it.
const WARM_UP_US: u64 = (1.0e6 * WARM_UP_S) as u64;

type Step = Result<(SensorFrame, Option<Truth>), HostError>;

/// Sensor frames, and what was true where that is known.
pub struct Source {
    origin: Origin,
    rover: Rover<f64>,
    assumed: AssumedKeys,
    remarks: Remarks,
    /// Whether a truth is beside the frames.
    has_truth: bool,
    steps: Box<dyn Iterator<Item = Step>>,
}

impl Source {
    /// The traverse that the project carries.
    ///
    /// # Errors
    /// Where the simulation does not start.
    pub fn carried() -> Result<Self, HostError> {
        let (scenario, seed) = CARRIED;
        let failed = move |error| scenario.failed(seed, error);
        let RoverFile { rover, assumed, .. } = RoverFile::assumed();
        let traverse = Traverse::new(scenario, seed, &rover, &Options::default()).map_err(failed)?;
        let bar = ProgressBar::new(traverse.frames()).with_finish(ProgressFinish::AndClear);
        let steps = traverse
            .progress_with(bar)
            .map(move |step| step.map(|(frame, truth)| (frame, Some(truth))).map_err(failed));
        let origin = Origin::Simulated { scenario, seed };
        Ok(Self { origin, rover, assumed, remarks: Remarks::default(), has_truth: true, steps: Box::new(steps) })
    }

    /// A recording, with the truth where NAME.truth.csv is beside it.
    ///
    /// # Errors
    /// Where a file cannot be read, or is not what it should be.
    pub fn recorded(frames: &Path, rover: Option<&Path>) -> Result<Self, HostError> {
        let recording = Recording::open(frames, rover)?;
        let remarks = recording.remarks();
        let Recording { rover, assumed, frames: recorded } = recording;
        let truths = truth_path(frames);
        let has_truth = truths.is_file();
        let mut truths = if has_truth { Some(TruthReader::open(&truths)?.peekable()) } else { None };
        let steps = recorded.map(move |frame| {
            let frame = frame?;
            let Some(truths) = &mut truths else { return Ok((frame, None)) };
            let at_last =
                |truth: &Result<Truth, _>| truth.as_ref().map_or(true, |truth| truth.time_us >= frame.time_us);
            while truths.next_if(|truth| !at_last(truth)).is_some() {}
            let same = |truth: &Result<Truth, _>| truth.as_ref().map_or(true, |truth| truth.time_us == frame.time_us);
            Ok((frame, truths.next_if(same).transpose()?))
        });
        let name = frames.file_name().unwrap_or(frames.as_os_str()).to_string_lossy().into_owned();
        Ok(Self { origin: Origin::Recorded(name), rover, assumed, remarks, has_truth, steps: Box::new(steps) })
    }
}

/// What is gathered while estimates come.
struct Gathered {
    rover: Rover<f64>,
    samples: Samples,
    /// What the raw sensors said, where that is compared with a truth.
    trailing: Option<TrailingMean>,
    /// Time of the first frame, µs: clocks start anywhere.
    start_us: Option<u64>,
    /// Frames of which the truth is known.
    with_truth: u64,
    errors: Option<Errors>,
    /// Checksum over the bits of all estimates so far.
    fingerprint: u32,
}

impl TraverseFindings {
    /// Sends frames to a flight computer, and gathers what it makes of them.
    ///
    /// # Errors
    /// Where the computer cannot be had, does not pass its self-test or does not answer, or a frame cannot be read.
    pub fn gather(source: Source, on: Computer) -> Result<Self, HostError> {
        let Source { origin, rover, assumed, remarks, has_truth, steps } = source;
        let flight_rover = rover.map(|value| value as f32);
        let mut computer = FlightComputer::start(on, LogView::Nothing)?;
        // Estimates come some frames after what they are of.
        let under_way = RefCell::new(VecDeque::new());
        let frames = steps.map(|step| {
            let (frame, truth) = step?;
            under_way.borrow_mut().push_back((frame, truth));
            Ok(frame)
        });
        let mut gathered = Gathered::new(rover, has_truth);
        let outcome = replay(&mut computer, &flight_rover, frames, |estimate| {
            let step = under_way.borrow_mut().pop_front();
            step.iter().try_for_each(|(frame, truth)| gathered.take(frame, truth.as_ref(), estimate))
        })?;
        let Gathered { samples, with_truth, errors, fingerprint, .. } = gathered;
        let flight = FlightFacts {
            computer: on,
            boot: outcome.boot,
            health: outcome.health,
            memory: computer.memory(),
            log: computer.into_log(),
            fingerprint: format!("{fingerprint:08x}"),
            networks: None,
        };
        let truth_is_of_other_times = has_truth && with_truth == 0;
        Ok(Self {
            origin,
            rover: flight_rover,
            assumed,
            remarks: remarks.lines(),
            samples,
            truth_is_of_other_times,
            errors,
            outcome,
            flight,
        })
    }
}

impl Gathered {
    fn new(rover: Rover<f64>, has_truth: bool) -> Self {
        let trailing = has_truth.then(TrailingMean::default);
        let samples = Samples::default();
        Self { rover, samples, trailing, start_us: None, with_truth: 0, errors: None, fingerprint: 0 }
    }

    fn take(&mut self, frame: &SensorFrame, truth: Option<&Truth>, estimate: &FrameEstimate) -> Result<(), HostError> {
        self.samples.push(estimate, truth);
        self.with_truth += u64::from(truth.is_some());
        let start_us = *self.start_us.get_or_insert(frame.time_us);
        if let Some(trailing) = &mut self.trailing {
            let now = naive(&self.rover, frame);
            let second = trailing.push(frame.time_us, now);
            if let Some(truth) = truth.filter(|_| frame.time_us.saturating_sub(start_us) >= WARM_UP_US) {
                self.errors.get_or_insert_default().take(estimate, &now, &second, truth);
            }
        }
        let bytes = postcard::to_stdvec(&(self.fingerprint, estimate))
            .map_err(|error| HostError::Failed(format!("the estimates have no fingerprint: {error}")))?;
        self.fingerprint = Checksum::of(&bytes);
        Ok(())
    }
}
