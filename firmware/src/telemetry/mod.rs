//! Requests in, replies out: what every board runs around the pipeline, and the host runs in its own process.

mod estimation;
mod noticed;

use embedded_io::{Read, ReadReady, Write};

use crate::estimator::EstimatorHealth;
use crate::link::{
    BootReport, FrameRefusal, HealthReport, Incoming, Link, LinkError, NO_SEQUENCE, Reply, Request, RoverSource,
};
use crate::pipeline;
use crate::rover::{GeometryError, Rover};
use crate::self_test::{self, SelfTestReport};
use crate::sensor_frame::SensorFrame;
use crate::soil::{QueryAnswer, Refusal};
use crate::wheel_state::SoilQuery;

use estimation::Estimation;
pub use noticed::{Noticed, SensorChange};

/// What only the board knows about itself.
pub trait Board {
    /// The deepest that the stack has been since boot, bytes; `None` where it cannot be measured.
    fn stack_high_water_bytes(&mut self) -> Option<u32>;
}

/// What [`Telemetry::serve`] did, for the board's log.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// Somebody said hello.
    Greeted,
    /// A soil query was answered.
    Queried,
    /// A rover was configured, or refused.
    Configured(Result<(), GeometryError>),
    /// A sensor frame went through the pipeline.
    Estimated(Noticed),
    /// A sensor frame came again, and was answered as before.
    Repeated,
    /// A sensor frame was not taken.
    FrameRefused(FrameRefusal),
    /// Link and memory, or sensors and filters, were reported.
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
    /// None where there is no rover.
    estimation: Option<Estimation>,
    last_served: u16,
    queries_answered: u32,
    frames_taken: u32,
}

impl<U: Read + ReadReady + Write, B: Board> Telemetry<U, B> {
    /// A flight computer behind `port` that gives no estimates until [`Self::start`].
    pub fn new(port: U, board: B) -> Self {
        Self {
            link: Link::new(port),
            board,
            self_test: SelfTestReport::default(),
            estimation: None,
            last_served: NO_SEQUENCE,
            queries_answered: 0,
            frames_taken: 0,
        }
    }

    /// Runs the self-test, then estimates for the assumed rover K0.
    pub fn start(&mut self) {
        self.self_test = self_test::run();
        // K0 is a rover that can be; if it were not, frames would be refused with that reason.
        let _ = self.estimate_for(&Rover::assumed(), RoverSource::Assumed);
    }

    /// The self-test that ran at boot, or since then on request.
    pub fn self_test(&self) -> SelfTestReport {
        self.self_test
    }

    /// The serial port.
    pub fn port(&mut self) -> &mut U {
        self.link.port()
    }

    /// Answers the next frame, if one has arrived. Never waits for one. Never inlined: what is asked and answered takes kilobytes,
    /// and whoever calls this has called [`Self::start`], for which they would be kept free in vain.
    #[inline(never)]
    pub fn serve(&mut self) -> Option<Event> {
        let Incoming { sequence, request } = self.link.receive()?;
        let (reply, event) = match request {
            Ok(request) => self.reply(sequence, &request),
            Err(error) => (Reply::Error(error), Event::Refused(error)),
        };
        // A frame that is sent again counts as well: where an old question that was asked again had led back, it is what is waited for.
        if !matches!(event, Event::FrameRefused(FrameRefusal::OutOfOrder { .. }) | Event::Refused(_)) {
            self.last_served = sequence;
        }
        self.link.send(sequence, &reply);
        Some(event)
    }

    fn reply(&mut self, sequence: u16, request: &Request) -> (Reply, Event) {
        match request {
            Request::Hello => {
                self.estimation.iter_mut().for_each(Estimation::forget_numbers);
                (Reply::Boot(self.boot_report()), Event::Greeted)
            }
            Request::Estimate(query) => (Reply::Estimate(self.estimate(query)), Event::Queried),
            Request::Health => (Reply::Health(self.health_report()), Event::HealthReported),
            Request::SelfTest => {
                self.self_test = self_test::run();
                (Reply::SelfTest(self.self_test), Event::SelfTested(self.self_test))
            }
            Request::Configure(rover) => {
                let outcome = self.estimate_for(rover, RoverSource::Configured);
                (Reply::Configured(outcome), Event::Configured(outcome))
            }
            Request::Frame(frame) => self.take_frame(sequence, frame),
            Request::EstimatorHealth => (Reply::EstimatorHealth(self.estimator_health()), Event::HealthReported),
        }
    }

    /// Starts the estimates anew.
    fn estimate_for(&mut self, rover: &Rover<f32>, source: RoverSource) -> Result<(), GeometryError> {
        rover.check()?;
        if self.estimation.is_none() {
            self.make_estimation(rover, source);
        }
        self.estimation.as_mut().map_or(Ok(()), |estimation| estimation.restart(rover, source))
    }

    /// Never inlined: what is being made may pass through the stack, where the frame of a caller would keep its place.
    #[inline(never)]
    fn make_estimation(&mut self, rover: &Rover<f32>, source: RoverSource) {
        self.estimation = Some(Estimation::not_begun(rover, source));
    }

    fn take_frame(&mut self, sequence: u16, frame: &SensorFrame) -> (Reply, Event) {
        let event = self.tick(sequence, frame);
        let estimate = match (&event, &self.estimation) {
            (Event::FrameRefused(reason), _) => Err(*reason),
            (_, Some(estimation)) => Ok(*estimation.last()),
            (_, None) => Err(FrameRefusal::NoRover),
        };
        (Reply::Frame(estimate), event)
    }

    /// Never inlined, as [`Self::make_estimation`].
    #[inline(never)]
    fn tick(&mut self, sequence: u16, frame: &SensorFrame) -> Event {
        let taken = match &mut self.estimation {
            None => Err(FrameRefusal::NoRover),
            Some(_) if !self.self_test.passed() => Err(FrameRefusal::SelfTestFailed),
            Some(estimation) => estimation.take(frame, sequence, self.last_served),
        };
        match taken {
            Ok(Some(noticed)) => {
                self.frames_taken = self.frames_taken.saturating_add(1);
                Event::Estimated(noticed)
            }
            Ok(None) => Event::Repeated,
            Err(reason) => Event::FrameRefused(reason),
        }
    }

    fn estimator_health(&self) -> EstimatorHealth {
        self.estimation.as_ref().map_or(EstimatorHealth::NOTHING, |estimation| *estimation.health())
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
        BootReport {
            firmware_version: FIRMWARE_VERSION,
            self_test: self.self_test,
            rover: self.estimation.as_ref().map(Estimation::source),
        }
    }

    fn health_report(&mut self) -> HealthReport {
        HealthReport {
            link: self.link.health(),
            queries_answered: self.queries_answered,
            frames_taken: self.frames_taken,
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
