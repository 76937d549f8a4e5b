//! How well the link does.

use serde::{Deserialize, Serialize};

use super::frame::LinkError;

/// What happened on the link since boot. Counters stop at their greatest value.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct LinkHealth {
    /// Frames that arrived whole and were understood.
    #[serde(with = "crate::outlined")]
    pub frames_ok: u32,
    /// Frames longer than any message.
    #[serde(with = "crate::outlined")]
    pub oversized: u32,
    /// Frames that ended before their announced end.
    #[serde(with = "crate::outlined")]
    pub cut: u32,
    /// Frames too short to hold a header and a checksum.
    #[serde(with = "crate::outlined")]
    pub short: u32,
    /// Frames with a wrong checksum.
    #[serde(with = "crate::outlined")]
    pub checksum: u32,
    /// Frames of another protocol version.
    #[serde(with = "crate::outlined")]
    pub version: u32,
    /// Frames with a right checksum that are no message.
    #[serde(with = "crate::outlined")]
    pub undecodable: u32,
    /// Times that a request's number was not the one after the last.
    #[serde(with = "crate::outlined")]
    pub sequence_gaps: u32,
    /// Requests that came twice in a row; they are answered again.
    #[serde(with = "crate::outlined")]
    pub duplicates: u32,
    /// Errors of the serial port while receiving: overruns.
    #[serde(with = "crate::outlined")]
    pub receive_errors: u32,
    /// Replies that could not be sent.
    #[serde(with = "crate::outlined")]
    pub replies_lost: u32,
}

impl LinkHealth {
    /// Counts a refused frame.
    pub(super) fn count(&mut self, error: LinkError) {
        let counter = match error {
            LinkError::Oversized => &mut self.oversized,
            LinkError::Cut => &mut self.cut,
            LinkError::Short => &mut self.short,
            LinkError::Checksum => &mut self.checksum,
            LinkError::Version => &mut self.version,
            LinkError::Undecodable => &mut self.undecodable,
        };
        increment(counter);
    }

    /// The number of refused frames.
    pub fn refused(&self) -> u32 {
        [self.oversized, self.cut, self.short, self.checksum, self.version, self.undecodable]
            .into_iter()
            .fold(0, u32::saturating_add)
    }
}

/// One more, up to the greatest value.
pub(super) fn increment(counter: &mut u32) {
    *counter = counter.saturating_add(1);
}
