//! The flight image in QEMU, over its serial port.

use std::io::{Read, Write};
use std::os::unix::net::UnixStream;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

use crate::error::HostError;
use crate::qemu::{LogLine, Machine};

use super::Line;

/// The host's end of the serial line. A thread reads it all the time, so that neither side waits for the other to read.
pub(super) struct InQemu {
    machine: Machine,
    to_computer: UnixStream,
    to_host: Receiver<Vec<u8>>,
}

impl InQemu {
    pub fn connect(machine: Machine) -> Result<Self, HostError> {
        let to_computer = machine.link()?;
        let from_computer = machine.link()?;
        let (sender, to_host) = channel();
        std::thread::spawn(move || read_all(from_computer, &sender));
        Ok(Self { machine, to_computer, to_host })
    }
}

/// Passes on what comes, until the line or whoever listens is gone.
fn read_all(mut stream: UnixStream, sender: &Sender<Vec<u8>>) {
    let mut buffer = [0; 4096];
    while let Ok(count @ 1..) = stream.read(&mut buffer) {
        if sender.send(buffer.get(..count).unwrap_or(&[]).to_vec()).is_err() {
            return;
        }
    }
}

impl Line for InQemu {
    fn send(&mut self, bytes: &[u8]) -> Result<(), HostError> {
        self.to_computer.write_all(bytes).map_err(|error| HostError::Failed(format!("does not listen ({error})")))
    }

    fn receive(&mut self, patience: Duration) -> Result<Vec<u8>, HostError> {
        match self.to_host.recv_timeout(patience) {
            Ok(bytes) => Ok(bytes),
            Err(RecvTimeoutError::Timeout) => Ok(Vec::new()),
            Err(RecvTimeoutError::Disconnected) => Err(HostError::Failed("has hung up".to_owned())),
        }
    }

    fn into_log(self: Box<Self>) -> Vec<LogLine> {
        self.machine.into_log()
    }

    fn post_mortem(self: Box<Self>) -> String {
        self.machine.post_mortem()
    }
}
