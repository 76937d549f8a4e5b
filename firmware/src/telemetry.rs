//! Requests in, replies out: what every board runs around the pipeline, and the host runs in its own process.

use embedded_io::{Read, ReadReady, Write};

use crate::link::{BootReport, HealthReport, Incoming, Link, LinkError, Reply, Request};
use crate::pipeline;
use crate::self_test::{self, SelfTestReport};
use crate::soil::{QueryAnswer, Refusal};
use crate::wheel_state::SoilQuery;

/// What only the board knows about itself.
pub trait Board {
    /// The deepest that the stack has been since boot, bytes; `None` where it cannot be measured.
    fn stack_high_water_bytes(&mut self) -> Option<u32>;
}

/// What [`Telemetry::serve`] did, for the board's log.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Event {
    /// Somebody said hello.
    Greeted,
    /// A soil query was answered.
    Estimated,
    /// Link and memory were reported.
    HealthReported,
    /// The self-test ran again.
    SelfTested(SelfTestReport),
    /// A frame was refused.
    Refused(LinkError),
}

/// The flight computer as its link sees it.
#[derive(Debug)]
pub struct Telemetry<U, B> {
    link: Link<U>,
    board: B,
    self_test: SelfTestReport,
    queries_answered: u32,
}

impl<U: Read + ReadReady + Write, B: Board> Telemetry<U, B> {
    /// Runs the self-test, then stands ready to answer over `port`.
    pub fn boot(port: U, board: B) -> Self {
        Self { link: Link::new(port), board, self_test: self_test::run(), queries_answered: 0 }
    }

    /// The self-test that ran at boot, or since then on request.
    pub fn self_test(&self) -> SelfTestReport {
        self.self_test
    }

    /// The serial port.
    pub fn port(&mut self) -> &mut U {
        self.link.port()
    }

    /// Answers the next frame, if one has arrived. Never waits for one.
    pub fn serve(&mut self) -> Option<Event> {
        let Incoming { sequence, request } = self.link.receive()?;
        let (reply, event) = match request {
            Ok(request) => self.reply(&request),
            Err(error) => (Reply::Error(error), Event::Refused(error)),
        };
        self.link.send(sequence, &reply);
        Some(event)
    }

    fn reply(&mut self, request: &Request) -> (Reply, Event) {
        match request {
            Request::Hello => (Reply::Boot(self.boot_report()), Event::Greeted),
            Request::Estimate(query) => (Reply::Estimate(self.estimate(query)), Event::Estimated),
            Request::Health => (Reply::Health(self.health_report()), Event::HealthReported),
            Request::SelfTest => {
                self.self_test = self_test::run();
                (Reply::SelfTest(self.self_test), Event::SelfTested(self.self_test))
            }
        }
    }

    fn estimate(&mut self, query: &SoilQuery) -> QueryAnswer {
        self.queries_answered = self.queries_answered.saturating_add(1);
        if self.self_test.passed() {
            pipeline::answer(query)
        } else {
            QueryAnswer::refused(query.wheels.len(), Refusal::SelfTestFailed)
        }
    }

    fn boot_report(&self) -> BootReport {
        BootReport { firmware_version: FIRMWARE_VERSION, self_test: self.self_test }
    }

    fn health_report(&mut self) -> HealthReport {
        HealthReport {
            link: self.link.health(),
            queries_answered: self.queries_answered,
            stack_high_water_bytes: self.board.stack_high_water_bytes(),
        }
    }
}

/// The package's version, from the manifest.
const FIRMWARE_VERSION: [u8; 3] = [
    version_part(env!("CARGO_PKG_VERSION_MAJOR")),
    version_part(env!("CARGO_PKG_VERSION_MINOR")),
    version_part(env!("CARGO_PKG_VERSION_PATCH")),
];

/// Only for constants: the panic is the compiler's, and stops the build.
const fn version_part(text: &str) -> u8 {
    match u8::from_str_radix(text, 10) {
        Ok(number) => number,
        Err(_) => panic!("a part of the package version does not fit a byte"),
    }
}
