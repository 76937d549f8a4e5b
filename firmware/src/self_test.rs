//! What the image checks at boot, before its first estimate.

use serde::{Deserialize, Serialize};

/// The result of the boot self-test.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SelfTestReport {
    /// The checksum of the frozen table in flash is the one that it was built with.
    pub table_crc_ok: bool,
    /// Every golden input gave its golden output, bit for bit.
    pub golden_ok: bool,
    /// How many golden pairs were tried.
    pub golden_pairs: u8,
}

impl SelfTestReport {
    /// Whether estimates may be given.
    pub fn passed(&self) -> bool {
        self.table_crc_ok && self.golden_ok
    }
}

/// Checks the frozen tables. The image carries none yet, so there is nothing that could be wrong.
pub fn run() -> SelfTestReport {
    SelfTestReport { table_crc_ok: true, golden_ok: true, golden_pairs: 0 }
}
