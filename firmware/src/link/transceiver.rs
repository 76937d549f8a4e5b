//! The link over a serial port.

use embedded_io::{Read, ReadReady, Write};

use super::frame::{FrameBuffer, Header, LinkError, NO_SEQUENCE, next_sequence};
use super::health::{LinkHealth, increment};
use super::message::{Reply, Request};
use super::receiver::FrameReceiver;

/// The most bytes taken from the port in one call: somewhat more than the longest frame.
const RECEIVE_BUDGET: usize = 1024;

/// A frame that arrived: its sequence number, and the request or why there is none.
#[derive(Debug, Clone, PartialEq)]
pub struct Incoming {
    /// The number that the reply repeats; [`NO_SEQUENCE`] where it could not be read.
    pub sequence: u16,
    /// What is asked, or why it was refused.
    pub request: Result<Request, LinkError>,
}

/// The flight computer's end of the link.
#[derive(Debug)]
pub struct Link<U> {
    port: U,
    receiver: FrameReceiver,
    buffer: FrameBuffer,
    health: LinkHealth,
    last_sequence: Option<u16>,
}

impl<U: Read + ReadReady + Write> Link<U> {
    /// A link over a serial port.
    pub fn new(port: U) -> Self {
        Self {
            port,
            receiver: FrameReceiver::new(),
            buffer: FrameBuffer::new(),
            health: LinkHealth::default(),
            last_sequence: None,
        }
    }

    /// The counters.
    pub fn health(&self) -> LinkHealth {
        self.health
    }

    /// The serial port.
    pub fn port(&mut self) -> &mut U {
        &mut self.port
    }

    /// Takes what the port has received, up to the end of a frame. Never waits.
    pub fn receive(&mut self) -> Option<Incoming> {
        for _ in 0..RECEIVE_BUDGET {
            let byte = self.next_byte()?;
            let incoming = match self.receiver.push(byte) {
                None => continue,
                Some(Ok(frame)) => Incoming { sequence: frame.header.sequence, request: frame.decode() },
                Some(Err(error)) => Incoming { sequence: NO_SEQUENCE, request: Err(error) },
            };
            self.record(&incoming);
            return Some(incoming);
        }
        None
    }

    /// Sends a reply. One that cannot be sent is counted; whoever asked asks again.
    pub fn send(&mut self, sequence: u16, reply: &Reply) {
        let sent = match self.buffer.encode(Header::new(sequence), reply) {
            Ok(bytes) => write_bounded(&mut self.port, bytes),
            Err(_) => false,
        };
        if !sent {
            increment(&mut self.health.replies_lost);
        }
    }

    fn next_byte(&mut self) -> Option<u8> {
        let mut byte = [0];
        let received = match self.port.read_ready() {
            Ok(false) => return None,
            Ok(true) => self.port.read(&mut byte),
            Err(error) => Err(error),
        };
        match received {
            Ok(0) => None,
            Ok(_) => byte.first().copied(),
            Err(_) => {
                increment(&mut self.health.receive_errors);
                None
            }
        }
    }

    fn record(&mut self, incoming: &Incoming) {
        match &incoming.request {
            Err(error) => self.health.count(*error),
            Ok(request) => {
                increment(&mut self.health.frames_ok);
                let expected = match request {
                    Request::Hello => None,
                    _ => self.last_sequence,
                };
                match expected {
                    Some(last) if last == incoming.sequence => increment(&mut self.health.duplicates),
                    Some(last) if next_sequence(last) != incoming.sequence => increment(&mut self.health.sequence_gaps),
                    _ => (),
                }
                self.last_sequence = Some(incoming.sequence);
            }
        }
    }
}

/// Writes all bytes; each write that does not fail takes at least one, so the loop ends.
fn write_bounded<W: Write>(port: &mut W, bytes: &[u8]) -> bool {
    let mut rest = bytes;
    for _ in 0..bytes.len() {
        match port.write(rest) {
            Ok(written) => rest = rest.get(written..).unwrap_or(&[]),
            Err(_) => return false,
        }
        if rest.is_empty() {
            return port.flush().is_ok();
        }
    }
    rest.is_empty()
}
