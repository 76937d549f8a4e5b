//! How well the link does.

use serde::{Deserialize, Serialize};

use super::frame::LinkError;

/// What happened on the link since boot. Counters stop at their greatest value.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct LinkHealth {
    /// Frames that arrived whole and were understood.
    pub frames_ok: u32,
    /// Frames longer than any message.
    pub oversized: u32,
    /// Frames that ended before their announced end.
    pub cut: u32,
    /// Frames too short to hold a header and a checksum.
    pub short: u32,
    /// Frames with a wrong checksum.
    pub checksum: u32,
    /// Frames of another protocol version.
    pub version: u32,
    /// Frames with a right checksum that are no message.
    pub undecodable: u32,
    /// Times that a request's number was not the one after the last.
    pub sequence_gaps: u32,
    /// Requests that came twice in a row; they are answered again.
    pub duplicates: u32,
    /// Errors of the serial port while receiving: overruns.
    pub receive_errors: u32,
    /// Replies that could not be sent.
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
