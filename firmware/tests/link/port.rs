//! A serial port for tests.

use std::collections::VecDeque;
use std::convert::Infallible;

use embedded_io::{ErrorType, Read, ReadReady, Write};

/// A serial port made of memory.
#[derive(Default)]
pub struct Port {
    /// What the flight computer has yet to read.
    pub input: VecDeque<u8>,
    /// What it has sent.
    pub output: Vec<u8>,
}

impl ErrorType for Port {
    type Error = Infallible;
}
impl ReadReady for Port {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        Ok(!self.input.is_empty())
    }
}
impl Read for Port {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize, Infallible> {
        Ok(buffer.iter_mut().map_while(|slot| self.input.pop_front().map(|byte| *slot = byte)).count())
    }
}
impl Write for Port {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        self.output.extend_from_slice(bytes);
        Ok(bytes.len())
    }
    fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}
