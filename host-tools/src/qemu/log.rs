//! The image's log, decoded with the strings that its ELF file keeps.

use std::io::{IsTerminal, Read};
use std::os::unix::net::UnixStream;
use std::thread::JoinHandle;

use defmt_decoder::{DecodeError, StreamDecoder, Table};
use defmt_parser::Level;

use crate::error::HostError;

use super::Image;

/// One line of the image's log.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LogLine {
    /// `TRACE` to `ERROR`; empty for a plain print.
    pub level: &'static str,
    /// When, since boot, and what.
    pub text: String,
}

/// What of the log is shown on standard error while it comes in. All of it is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum LogView {
    /// Information, warnings and errors.
    Information,
    /// Warnings and errors.
    Warnings,
    /// Nothing.
    Nothing,
}

impl LogView {
    fn shows(self, level: Option<Level>) -> bool {
        match self {
            Self::Information => level.is_none_or(|level| level >= Level::Info),
            Self::Warnings => level.is_some_and(|level| level >= Level::Warn),
            Self::Nothing => false,
        }
    }
}

/// The log of a running image, gathered by a thread of its own until the image ends.
#[derive(Debug)]
pub(super) struct Log {
    reader: Option<JoinHandle<Vec<LogLine>>>,
}

impl Log {
    /// Decodes what comes out of `stream`.
    pub fn follow(image: &Image, stream: UnixStream, view: LogView) -> Result<Self, HostError> {
        let bad = |reason: String| HostError::Failed(format!("{}: {reason}", image.path().display()));
        let table = Table::parse(&image.read()?)
            .map_err(|error| bad(error.to_string()))?
            .ok_or_else(|| bad("no strings of a log in this image".to_owned()))?;
        Ok(Self { reader: Some(std::thread::spawn(move || follow(stream, &table, view))) })
    }

    /// Waits for the end of the stream, which the end of QEMU brings, and gives all that was logged, once.
    pub fn finish(&mut self) -> Vec<LogLine> {
        self.reader.take().and_then(|reader| reader.join().ok()).unwrap_or_default()
    }
}

fn follow(mut stream: UnixStream, table: &Table, view: LogView) -> Vec<LogLine> {
    let mut decoder = table.new_stream_decoder();
    let mut buffer = [0; 4096];
    let mut lines = Vec::new();
    while let Ok(count @ 1..) = stream.read(&mut buffer) {
        decoder.received(buffer.get(..count).unwrap_or(&[]));
        drain(decoder.as_mut(), view, &mut lines);
    }
    lines
}

/// Takes every whole line that the decoder has.
fn drain(decoder: &mut dyn StreamDecoder, view: LogView, lines: &mut Vec<LogLine>) {
    loop {
        let line = match decoder.decode() {
            Ok(frame) => {
                if view.shows(frame.level()) {
                    eprintln!("{}", frame.display(std::io::stderr().is_terminal()));
                }
                let time = frame.display_timestamp().map(|time| format!("{time} ")).unwrap_or_default();
                let level = frame.level().map_or("", |level| level.as_str());
                LogLine { level, text: format!("{time}{}", frame.display_message()) }
            }
            Err(DecodeError::UnexpectedEof) => return,
            Err(DecodeError::Malformed) => LogLine { level: "", text: "(a damaged line)".to_owned() },
        };
        lines.push(line);
    }
}
