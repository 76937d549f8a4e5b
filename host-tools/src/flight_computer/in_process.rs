//! The flight library in this process, behind the same link.

use std::collections::VecDeque;
use std::convert::Infallible;
use std::time::Duration;

use embedded_io::{ErrorType, Read, ReadReady, Write};
use kapvik_firmware::telemetry::{Board, Telemetry};

use crate::error::HostError;
use crate::qemu::LogLine;

use super::Line;

/// The flight library over a serial port made of memory.
pub(super) struct InProcess {
    telemetry: Telemetry<MemoryPort, ThisProcess>,
}

impl InProcess {
    pub fn boot() -> Self {
        let mut telemetry = Telemetry::new(MemoryPort::default(), ThisProcess);
        telemetry.start();
        Self { telemetry }
    }
}

impl Line for InProcess {
    fn send(&mut self, bytes: &[u8]) -> Result<(), HostError> {
        self.telemetry.port().to_computer.extend(bytes);
        while !self.telemetry.port().to_computer.is_empty() {
            self.telemetry.serve();
        }
        Ok(())
    }

    fn receive(&mut self, _: Duration) -> Result<Vec<u8>, HostError> {
        Ok(std::mem::take(&mut self.telemetry.port().to_host))
    }

    fn into_log(self: Box<Self>) -> Vec<LogLine> {
        Vec::new()
    }

    fn post_mortem(self: Box<Self>) -> String {
        "it runs in this process".to_owned()
    }
}

/// This process as a board: its stack is not the flight computer's.
struct ThisProcess;

impl Board for ThisProcess {
    fn stack_high_water_bytes(&mut self) -> Option<u32> {
        None
    }
}

#[derive(Default)]
struct MemoryPort {
    to_computer: VecDeque<u8>,
    to_host: Vec<u8>,
}

impl ErrorType for MemoryPort {
    type Error = Infallible;
}

impl ReadReady for MemoryPort {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        Ok(!self.to_computer.is_empty())
    }
}

impl Read for MemoryPort {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize, Infallible> {
        Ok(buffer.iter_mut().map_while(|slot| self.to_computer.pop_front().map(|byte| *slot = byte)).count())
    }
}

impl Write for MemoryPort {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        self.to_host.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}
