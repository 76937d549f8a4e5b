//! What is said over the link.

use serde::{Deserialize, Serialize};

use crate::estimator::EstimatorHealth;
use crate::pipeline::FrameEstimate;
use crate::rover::{GeometryError, Rover};
use crate::self_test::SelfTestReport;
use crate::sensor_frame::SensorFrame;
use crate::soil::QueryAnswer;
use crate::wheel_state::SoilQuery;

use super::{LinkError, LinkHealth};

/// What the flight computer can be asked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Request {
    /// Who is there? Starts the sequence numbers anew.
    Hello,
    /// What soil do these wheels stand on?
    Estimate(SoilQuery),
    /// How are link and memory?
    Health,
    /// Run the self-test again.
    SelfTest,
    /// This is the rover: estimate anew. A rover that cannot be changes nothing.
    Configure(Rover<f32>),
    /// What the sensors say: what are forces and soil? Frames are taken in the order of their numbers, each once: the
    /// last one, sent again, has the same answer again; one after a gap is refused until the gap is filled.
    Frame(SensorFrame),
    /// How are sensors and filters?
    EstimatorHealth,
}

/// What the flight computer says.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
// No allocator, so no box: the largest variant is the one that the buffers are sized for.
#[allow(clippy::large_enum_variant)]
pub enum Reply {
    /// To [`Request::Hello`].
    Boot(BootReport),
    /// To [`Request::Estimate`].
    Estimate(QueryAnswer),
    /// To [`Request::Health`].
    Health(HealthReport),
    /// To [`Request::SelfTest`].
    SelfTest(SelfTestReport),
    /// To [`Request::Configure`].
    Configured(Result<(), GeometryError>),
    /// To [`Request::Frame`].
    Frame(Result<FrameEstimate, FrameRefusal>),
    /// To [`Request::EstimatorHealth`].
    EstimatorHealth(EstimatorHealth),
    /// To a frame that was refused.
    Error(LinkError),
}

/// Why a sensor frame was not taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum FrameRefusal {
    /// No rover was configured.
    NoRover,
    /// The self-test found the networks altered.
    SelfTestFailed,
    /// Its number is neither that of the last frame nor the next one: something was lost on the link.
    OutOfOrder {
        /// The number that is waited for.
        expected: u16,
    },
}

/// Where the dimensions that the pipeline calculates with are from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum RoverSource {
    /// The assumed set K0, which is what the computer boots with.
    Assumed,
    /// [`Request::Configure`].
    Configured,
}

/// Who answers, and whether it may give estimates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct BootReport {
    /// Version of the flight library: major, minor, patch.
    pub firmware_version: [u8; 3],
    /// The self-test that ran at boot, or since then on request.
    pub self_test: SelfTestReport,
    /// Whose dimensions it calculates with; absent where it has none.
    pub rover: Option<RoverSource>,
}

/// How link and memory do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct HealthReport {
    /// The link's counters.
    pub link: LinkHealth,
    /// Soil queries answered since boot.
    #[serde(with = "crate::outlined")]
    pub queries_answered: u32,
    /// Sensor frames taken since boot; one that was sent again counts once.
    #[serde(with = "crate::outlined")]
    pub frames_taken: u32,
    /// The deepest that the stack has been since boot, bytes; absent where the computer cannot measure it.
    pub stack_high_water_bytes: Option<u32>,
}
