//! What is said over the link.

use serde::{Deserialize, Serialize};

use crate::self_test::SelfTestReport;
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
    /// To a frame that was refused.
    Error(LinkError),
}

/// Who answers, and whether it may give estimates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct BootReport {
    /// Version of the flight library: major, minor, patch.
    pub firmware_version: [u8; 3],
    /// The self-test that ran at boot, or since then on request.
    pub self_test: SelfTestReport,
}

/// How link and memory do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct HealthReport {
    /// The link's counters.
    pub link: LinkHealth,
    /// Soil queries answered since boot.
    pub queries_answered: u32,
    /// The deepest that the stack has been since boot, bytes; absent where the computer cannot measure it.
    pub stack_high_water_bytes: Option<u32>,
}
