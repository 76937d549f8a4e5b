//! Recorded sensor frames through a flight computer.

mod admitted;
mod camera_tilt;
mod dead_sensors;
mod doubts;
mod estimate_file;
mod gravity_felt;
mod gyro_felt;
pub mod health;
mod held_readings;
mod hub_paths;
mod joined_rows;
mod joint_signs;
mod motion_resistance;
pub mod naive;
mod never_together;
mod other_units;
mod raw_sensors;
mod recording;
mod rhythm;
mod running_median;
mod scatter;
mod still_clock;
mod terminal;
mod weighing;
mod wheel_signs;

use std::time::{Duration, Instant};

use kapvik_firmware::estimator::EstimatorHealth;
use kapvik_firmware::fusion::RoverSoil;
use kapvik_firmware::link::{BootReport, HealthReport};
use kapvik_firmware::pipeline::FrameEstimate;
use kapvik_firmware::rover::Rover;
use kapvik_firmware::sensor_frame::SensorFrame;
use kapvik_firmware::soil::Refusal;

use crate::error::HostError;
use crate::flight_computer::FlightComputer;

pub use doubts::Doubts;
pub use estimate_file::EstimateWriter;
pub use health::{REASONS, REPEATS, SensorTrouble, troubles};
pub use motion_resistance::MotionResistance;
pub use recording::{Recording, Remarks};
pub use scatter::{Noisier, Scatter};
pub use terminal::{filter_lines, lines};
pub use weighing::{Misfit, Weighing};

/// What is known once all frames went through.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// How many frames there were.
    pub frames: u64,
    /// Time of the first and of the last one, µs.
    pub span_us: (u64, u64),
    /// How long the replay took.
    pub took: Duration,
    /// The soil under the rover at the end.
    pub soil: Result<RoverSoil, Refusal>,
    /// Times at which another soil was noticed, µs.
    pub soil_changes_us: Vec<u64>,
    /// What the sensors show otherwise than rover file and the agreement on columns say, a sentence each, without capital and stop.
    pub doubts: Vec<String>,
    /// How sensors and filters did.
    pub estimator: EstimatorHealth,
    /// Who answered.
    pub boot: BootReport,
    /// How link and memory did.
    pub health: HealthReport,
}

/// What is counted while frames go through.
struct Counted {
    frames: u64,
    span_us: (u64, u64),
    soil: Result<RoverSoil, Refusal>,
    changes: u16,
    soil_changes_us: Vec<u64>,
}

/// Sends frames through a flight computer that starts anew for `rover`, and passes each one's estimates on to `take`.
///
/// # Errors
/// The first of the frames, of `take`, where there is no frame, and where the computer does not answer or refuses one.
pub fn replay(
    computer: &mut FlightComputer,
    rover: &Rover<f32>,
    frames: impl Iterator<Item = Result<SensorFrame, HostError>>,
    mut take: impl FnMut(&FrameEstimate) -> Result<(), HostError>,
) -> Result<Outcome, HostError> {
    computer.configure(rover)?;
    let boot = computer.passed_boot_report()?;
    let start = Instant::now();
    let mut counted: Option<Counted> = None;
    let mut doubts = Doubts::of(rover);
    let mut resistance = MotionResistance::of(rover);
    let looked_at = frames.inspect(|frame| frame.iter().for_each(|frame| doubts.take(frame)));
    computer.frames(looked_at, |estimate| {
        counted.get_or_insert_with(|| Counted::from(estimate.time_us)).count(&estimate);
        resistance.take(&estimate);
        take(&estimate)
    })?;
    let took = start.elapsed();
    let Counted { frames, span_us, soil, soil_changes_us, .. } =
        counted.ok_or_else(|| HostError::Failed("there is no frame to replay".to_owned()))?;
    let (estimator, health) = (computer.estimator_health()?, computer.health()?);
    let doubts = doubts.told().into_iter().chain(resistance.told()).collect();
    Ok(Outcome { frames, span_us, took, soil, soil_changes_us, doubts, estimator, boot, health })
}

impl Counted {
    fn from(time_us: u64) -> Self {
        Self {
            frames: 0,
            span_us: (time_us, time_us),
            soil: Err(Refusal::NotRolling),
            changes: 0,
            soil_changes_us: Vec::new(),
        }
    }

    fn count(&mut self, estimate: &FrameEstimate) {
        self.frames += 1;
        self.span_us.1 = estimate.time_us;
        self.soil = estimate.soil;
        if let Ok(soil) = &estimate.soil {
            if soil.changes > self.changes {
                self.soil_changes_us.push(estimate.time_us);
            }
            self.changes = soil.changes;
        }
    }
}

impl Outcome {
    /// How long the frames took when they were recorded, s.
    pub fn driven_s(&self) -> f64 {
        let (first, last) = self.span_us;
        1e-6 * last.saturating_sub(first) as f64
    }

    /// Frames per second of the replay.
    pub fn frames_per_second(&self) -> f64 {
        self.frames as f64 / self.took.as_secs_f64().max(1e-9)
    }

    /// How many times faster than real time the replay was.
    pub fn times_real_time(&self) -> f64 {
        self.driven_s() / self.took.as_secs_f64().max(1e-9)
    }
}
