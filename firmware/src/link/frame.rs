//! One frame: header, body, checksum, byte stuffing.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::{PAYLOAD_CAPACITY, WIRE_CAPACITY};
use crate::checksum::Checksum;

/// The version of the messages. A frame of another version is refused, never guessed at.
pub const PROTOCOL_VERSION: u8 = 2;

/// The sequence number of a reply to a frame whose own number could not be read. Requests are numbered from 1.
pub const NO_SEQUENCE: u16 = 0;

const CHECKSUM_BYTES: usize = 4;

/// The sequence number after `sequence`; [`NO_SEQUENCE`] is left out.
pub fn next_sequence(sequence: u16) -> u16 {
    sequence.checked_add(1).unwrap_or(NO_SEQUENCE + 1)
}

/// What stands before each body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Header {
    /// [`PROTOCOL_VERSION`] of the sender.
    pub version: u8,
    /// The request's number, which its reply repeats.
    pub sequence: u16,
}

impl Header {
    /// A header of this version.
    pub fn new(sequence: u16) -> Self {
        Self { version: PROTOCOL_VERSION, sequence }
    }
}

/// Why a frame was refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum LinkError {
    /// More bytes before the delimiter than the longest message has.
    Oversized,
    /// The delimiter came before the end that the byte stuffing announced: bytes were lost.
    Cut,
    /// Too short to hold a header and a checksum.
    Short,
    /// The checksum is not that of the bytes.
    Checksum,
    /// The sender speaks another version of the protocol.
    Version,
    /// The checksum is right, but the bytes are no message of this protocol.
    Undecodable,
}

/// A frame that arrived whole.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Frame<'a> {
    /// Its header.
    pub header: Header,
    body: &'a [u8],
}

impl<'a> Frame<'a> {
    /// Checks and splits the bytes of a frame after byte stuffing has been undone.
    pub(super) fn parse(payload: &'a [u8]) -> Result<Self, LinkError> {
        let (content, checksum) = payload.split_last_chunk::<CHECKSUM_BYTES>().ok_or(LinkError::Short)?;
        if Checksum::of(content) != u32::from_le_bytes(*checksum) {
            return Err(LinkError::Checksum);
        }
        let (version, _) = content.split_first().ok_or(LinkError::Short)?;
        if *version != PROTOCOL_VERSION {
            return Err(LinkError::Version);
        }
        let (header, body) = postcard::take_from_bytes(content).map_err(|_| LinkError::Undecodable)?;
        Ok(Self { header, body })
    }

    /// The message in the frame.
    ///
    /// # Errors
    /// [`LinkError::Undecodable`] where the bytes are not exactly one `T`.
    pub fn decode<T: DeserializeOwned>(&self) -> Result<T, LinkError> {
        match postcard::take_from_bytes(self.body) {
            Ok((message, [])) => Ok(message),
            _ => Err(LinkError::Undecodable),
        }
    }
}

/// Room to put a frame together.
#[derive(Debug, Clone)]
pub struct FrameBuffer {
    payload: [u8; PAYLOAD_CAPACITY],
    wire: [u8; WIRE_CAPACITY],
}

impl FrameBuffer {
    /// An empty buffer.
    pub const fn new() -> Self {
        Self { payload: [0; PAYLOAD_CAPACITY], wire: [0; WIRE_CAPACITY] }
    }

    /// The bytes of a frame, delimiter included.
    ///
    /// # Errors
    /// [`LinkError::Oversized`] where the message does not fit.
    pub fn encode<T: Serialize>(&mut self, header: Header, body: &T) -> Result<&[u8], LinkError> {
        let content = postcard::to_slice(&(header, body), &mut self.payload).map_err(|_| LinkError::Oversized)?.len();
        let checksum = Checksum::of(self.payload.get(..content).ok_or(LinkError::Oversized)?);
        let length = content + CHECKSUM_BYTES;
        self.payload.get_mut(content..length).ok_or(LinkError::Oversized)?.copy_from_slice(&checksum.to_le_bytes());
        let payload = self.payload.get(..length).ok_or(LinkError::Oversized)?;
        let stuffed = cobs::try_encode(payload, &mut self.wire).map_err(|_| LinkError::Oversized)?;
        *self.wire.get_mut(stuffed).ok_or(LinkError::Oversized)? = 0;
        self.wire.get(..=stuffed).ok_or(LinkError::Oversized)
    }
}

impl Default for FrameBuffer {
    fn default() -> Self {
        Self::new()
    }
}
