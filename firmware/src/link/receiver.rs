//! Bytes to frames, one byte at a time.

use cobs::{DecodeResult, DecoderState};
use heapless::Vec;

use super::PAYLOAD_CAPACITY;
use super::frame::{Frame, LinkError};

/// Finds the frames in a stream of bytes. Each call does a bounded amount of work, whatever the byte.
#[derive(Debug, Default)]
pub struct FrameReceiver {
    payload: Vec<u8, PAYLOAD_CAPACITY>,
    stuffing: DecoderState,
    /// The frame is longer than any message: what remains of it is skipped.
    overflowed: bool,
}

enum Progress {
    Incomplete,
    Complete,
    Failed(LinkError),
}

impl FrameReceiver {
    /// A receiver that waits for the first byte of a frame.
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes the next byte; gives a frame, or why there is none, when the byte was a delimiter that ended one.
    pub fn push(&mut self, byte: u8) -> Option<Result<Frame<'_>, LinkError>> {
        match self.advance(byte) {
            Progress::Incomplete => None,
            Progress::Complete => Some(Frame::parse(&self.payload)),
            Progress::Failed(error) => Some(Err(error)),
        }
    }

    fn advance(&mut self, byte: u8) -> Progress {
        if self.overflowed {
            if byte != 0 {
                return Progress::Incomplete;
            }
            self.overflowed = false;
            return Progress::Failed(LinkError::Oversized);
        }
        match self.stuffing.feed(byte) {
            Ok(DecodeResult::NoData) => Progress::Incomplete,
            Ok(DecodeResult::DataStart) => {
                self.payload.clear();
                Progress::Incomplete
            }
            Ok(DecodeResult::DataContinue(value)) => {
                if self.payload.push(value).is_err() {
                    self.overflowed = true;
                    self.stuffing = DecoderState::Idle;
                }
                Progress::Incomplete
            }
            Ok(DecodeResult::DataComplete) => Progress::Complete,
            // The decoder went back to its start: it fails on a delimiter and on nothing else.
            Err(_) => Progress::Failed(LinkError::Cut),
        }
    }
}
