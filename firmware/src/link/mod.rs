//! The serial link between the flight computer and whoever asks it: frames, checks, counters.
//!
//! On the wire a frame is
//!
//! ```text
//! COBS( postcard( Header ++ body ) ++ CRC-32 of that, little endian ) ++ 0x00
//! ```
//!
//! COBS leaves no zero inside a frame, so a receiver that lost its place finds it again at the next `0x00`, whatever
//! came before. Empty frames mean nothing: a sender that cannot know what came before it starts with a `0x00` of its
//! own. The checksum is CRC-32/ISO-HDLC.
//!
//! Nothing that arrives can stall or stop the receiver. A bad frame is counted in [`LinkHealth`] and answered with
//! [`Reply::Error`], which carries the reason.

mod frame;
mod health;
mod message;
mod receiver;
mod transceiver;

pub use frame::{Frame, FrameBuffer, Header, LinkError, NO_SEQUENCE, PROTOCOL_VERSION, next_sequence};
pub use health::LinkHealth;
pub use message::{BootReport, FrameRefusal, HealthReport, Reply, Request, RoverSource};
pub use receiver::FrameReceiver;
pub use transceiver::{Incoming, Link};

/// The most bytes of a frame before COBS: header, body and checksum. The longest message is a frame's estimate.
pub const PAYLOAD_CAPACITY: usize = 960;

/// The most bytes of a frame on the wire: one byte of overhead in 254, one to start and the delimiter.
pub const WIRE_CAPACITY: usize = PAYLOAD_CAPACITY + PAYLOAD_CAPACITY / 254 + 2;
