//! The test that the networks pass at boot, before the first estimate.

use serde::{Deserialize, Serialize};

use crate::estimator::doubt;
use crate::frozen;
use crate::network::{FLOWN_PAIRS, RoverTable, WheelTable, checksum};

/// What the test found; by default, nothing yet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SelfTestReport {
    /// A trained table is there; a build for training the first table of a new shape has none.
    pub trained: bool,
    /// The tables in memory, and the weights of the network that tells how true standard deviations are, are bit for bit those that were
    /// built in.
    pub tables_intact: bool,
    /// Golden pairs of the per-wheel network reproduced bit for bit, of [`FLOWN_PAIRS`].
    pub wheel_pairs: u8,
    /// Golden pairs of the rover network reproduced bit for bit, of [`FLOWN_PAIRS`].
    pub rover_pairs: u8,
}

impl SelfTestReport {
    /// Whether estimates may be given.
    pub fn passed(&self) -> bool {
        let pairs = usize::from(self.wheel_pairs.min(self.rover_pairs));
        self.trained && self.tables_intact && pairs == FLOWN_PAIRS
    }
}

/// Tests what is frozen.
pub fn run() -> SelfTestReport {
    let report = examine(&frozen::WHEEL, &frozen::ROVER);
    SelfTestReport { tables_intact: report.tables_intact && doubt::is_as_trained(doubt::frozen()), ..report }
}

/// Tests tables of the soil networks against the checksums of the frozen ones.
pub fn examine(wheel: &WheelTable<FLOWN_PAIRS>, rover: &RoverTable<FLOWN_PAIRS>) -> SelfTestReport {
    SelfTestReport {
        trained: frozen::FILE_CRC.is_some(),
        tables_intact: checksum(wheel) == frozen::WHEEL_CRC && checksum(rover) == frozen::ROVER_CRC,
        wheel_pairs: wheel.golden_reproduced() as u8,
        rover_pairs: rover.golden_reproduced() as u8,
    }
}
