//! The flight computer as the host talks to it, in this process or in QEMU: the same messages on the same link.

mod in_process;
mod in_qemu;
#[cfg(test)]
mod loss;
mod under_way;

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use clap::ValueEnum;
use kapvik_firmware::estimator::EstimatorHealth;
use kapvik_firmware::link::{
    BootReport, FrameBuffer, FrameReceiver, FrameRefusal, Header, HealthReport, NO_SEQUENCE, Reply, Request,
    next_sequence,
};
use kapvik_firmware::pipeline::FrameEstimate;
use kapvik_firmware::rover::Rover;
use kapvik_firmware::self_test::SelfTestReport;
use kapvik_firmware::sensor_frame::SensorFrame;
use kapvik_firmware::soil::QueryAnswer;
use kapvik_firmware::wheel_state::SoilQuery;

use crate::data::rover_fault::geometry_in_words;
use crate::error::HostError;
use crate::qemu::{Binary, Clock, Image, LogLine, LogView, Machine, MemoryUse};
use crate::setup::{self, Toolchain};

use in_process::InProcess;
use in_qemu::InQemu;
use under_way::UnderWay;

/// Where the flight library runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Computer {
    /// In this process
    Host,
    /// As the flight image, in QEMU
    Qemu,
}

/// The far end of a serial line.
trait Line: Send {
    /// Sends bytes.
    fn send(&mut self, bytes: &[u8]) -> Result<(), HostError>;
    /// What has come, or comes within `patience`; empty where nothing does.
    fn receive(&mut self, patience: Duration) -> Result<Vec<u8>, HostError>;
    /// Ends the computer and gives all that it logged before its last reply.
    fn into_log(self: Box<Self>) -> Vec<LogLine>;
    /// Ends the computer and describes how it was, for the text of an error.
    fn post_mortem(self: Box<Self>) -> String;
}

/// How many requests are under way at a time: enough to keep the line busy, few enough to wait for.
const WINDOW: usize = 16;
/// How long a reply may take before its request is sent again.
const PATIENCE: Duration = Duration::from_secs(20);
/// How often a request is sent before the computer is given up.
const TRIES: u32 = 3;

/// A flight computer that answers.
pub struct FlightComputer {
    line: Option<Box<dyn Line>>,
    receiver: FrameReceiver,
    buffer: FrameBuffer,
    last_sequence: u16,
    arrived: VecDeque<(u16, Reply)>,
    memory: Option<MemoryUse>,
}

impl FlightComputer {
    /// The flight library in this process.
    ///
    /// # Errors
    /// Where it does not answer.
    pub fn in_process() -> Result<Self, HostError> {
        Self::greet(Box::new(InProcess::boot()), None)
    }

    /// The flight image in QEMU. Its log is shown on standard error as far as `view` says.
    ///
    /// # Errors
    /// Where QEMU does not start, or the image does not answer.
    pub fn in_qemu(toolchain: &Toolchain, image: &Image, view: LogView) -> Result<Self, HostError> {
        let memory = MemoryUse::of(image)?;
        let machine = Machine::start(toolchain, image, Clock::Wall, view)?;
        Self::greet(Box::new(InQemu::connect(machine)?), Some(memory))
    }

    /// Either of the two; the image is built first, with what [`setup::prepare`] finds or installs.
    ///
    /// # Errors
    /// Where something is missing, the image does not build, or the computer does not answer.
    pub fn start(computer: Computer, view: LogView) -> Result<Self, HostError> {
        match computer {
            Computer::Host => Self::in_process(),
            Computer::Qemu => {
                let toolchain = setup::prepare(None)?;
                let image = Image::build(&toolchain, Binary::Flight)?;
                Self::in_qemu(&toolchain, &image, view)
            }
        }
    }

    fn greet(line: Box<dyn Line>, memory: Option<MemoryUse>) -> Result<Self, HostError> {
        let mut computer = Self {
            line: Some(line),
            receiver: FrameReceiver::new(),
            buffer: FrameBuffer::new(),
            last_sequence: NO_SEQUENCE,
            arrived: VecDeque::new(),
            memory,
        };
        computer.boot_report()?;
        Ok(computer)
    }

    /// Who answers, and how its self-test went.
    ///
    /// # Errors
    /// Where the computer does not answer.
    pub fn boot_report(&mut self) -> Result<BootReport, HostError> {
        match self.ask(&Request::Hello)? {
            Reply::Boot(report) => Ok(report),
            other => Err(unexpected(&other)),
        }
    }

    /// The same of one that is to be believed.
    ///
    /// # Errors
    /// Where the computer does not answer or has not passed its self-test.
    pub fn passed_boot_report(&mut self) -> Result<BootReport, HostError> {
        let boot = self.boot_report()?;
        match boot.self_test.passed() {
            true => Ok(boot),
            false => Err(HostError::Failed(format!("the flight computer's self-test failed: {:?}", boot.self_test))),
        }
    }

    /// The soil under the wheels of one query.
    ///
    /// # Errors
    /// Where the computer does not answer.
    pub fn query(&mut self, query: &SoilQuery) -> Result<QueryAnswer, HostError> {
        match self.ask(&Request::Estimate(query.clone()))? {
            Reply::Estimate(answer) => Ok(answer),
            other => Err(unexpected(&other)),
        }
    }

    /// As [`Self::query`] for many, several under way at a time.
    ///
    /// # Errors
    /// Where the computer does not answer.
    pub fn query_all(&mut self, queries: &[SoilQuery]) -> Result<Vec<QueryAnswer>, HostError> {
        let requests = queries.iter().cloned().map(|query| Ok(Request::Estimate(query)));
        let mut answers = Vec::new();
        self.ask_all(requests, |reply| match reply {
            Reply::Estimate(answer) => {
                answers.push(answer);
                Ok(())
            }
            other => Err(unexpected(&other)),
        })?;
        Ok(answers)
    }

    /// Starts the estimates anew, for this rover.
    ///
    /// # Errors
    /// Where the computer does not answer, or says that there can be no such rover.
    pub fn configure(&mut self, rover: &Rover<f32>) -> Result<(), HostError> {
        match self.ask(&Request::Configure(*rover))? {
            Reply::Configured(Ok(())) => Ok(()),
            Reply::Configured(Err(error)) => {
                Err(HostError::Failed(format!("the flight computer refuses this rover: {}", geometry_in_words(error))))
            }
            other => Err(unexpected(&other)),
        }
    }

    /// Sends sensor frames as they come, several under way at a time, and passes on each one's estimate in their order.
    /// Neither frames nor estimates are kept.
    ///
    /// # Errors
    /// The first of the frames, of `take`, and where the computer does not answer or refuses a frame.
    pub fn frames(
        &mut self,
        frames: impl Iterator<Item = Result<SensorFrame, HostError>>,
        mut take: impl FnMut(FrameEstimate) -> Result<(), HostError>,
    ) -> Result<(), HostError> {
        self.ask_all(frames.map(|frame| frame.map(Request::Frame)), |reply| match reply {
            Reply::Frame(Ok(estimate)) => take(estimate),
            Reply::Frame(Err(reason)) => {
                Err(HostError::Failed(format!("the flight computer refuses a frame: {reason:?}")))
            }
            other => Err(unexpected(&other)),
        })
    }

    /// How sensors and filters do.
    ///
    /// # Errors
    /// Where the computer does not answer.
    pub fn estimator_health(&mut self) -> Result<EstimatorHealth, HostError> {
        match self.ask(&Request::EstimatorHealth)? {
            Reply::EstimatorHealth(health) => Ok(health),
            other => Err(unexpected(&other)),
        }
    }

    /// How link and memory do.
    ///
    /// # Errors
    /// Where the computer does not answer.
    pub fn health(&mut self) -> Result<HealthReport, HostError> {
        match self.ask(&Request::Health)? {
            Reply::Health(report) => Ok(report),
            other => Err(unexpected(&other)),
        }
    }

    /// Runs the self-test again.
    ///
    /// # Errors
    /// Where the computer does not answer.
    pub fn self_test(&mut self) -> Result<SelfTestReport, HostError> {
        match self.ask(&Request::SelfTest)? {
            Reply::SelfTest(report) => Ok(report),
            other => Err(unexpected(&other)),
        }
    }

    /// Ends the computer and gives all that it logged before its last reply; nothing where it runs in this process.
    /// The log comes over a line of its own, behind the replies: before the end, part of it may be under way.
    pub fn into_log(mut self) -> Vec<LogLine> {
        self.line.take().map(Line::into_log).unwrap_or_default()
    }

    /// What the image takes; none where there is no image.
    pub fn memory(&self) -> Option<MemoryUse> {
        self.memory
    }

    /// Puts bytes on the line as they are: to see what the computer makes of bad ones.
    ///
    /// # Errors
    /// Where the line is gone.
    pub fn send_bytes(&mut self, bytes: &[u8]) -> Result<(), HostError> {
        self.with_line(|line| line.send(bytes))
    }

    /// The next reply with its sequence number, whatever it answers; `None` where none comes within `patience`.
    ///
    /// # Errors
    /// Where the line is gone or what comes over it is damaged.
    pub fn next_reply(&mut self, patience: Duration) -> Result<Option<(u16, Reply)>, HostError> {
        let deadline = Instant::now() + patience;
        while self.arrived.is_empty() {
            let bytes = self.with_line(|line| line.receive(deadline.saturating_duration_since(Instant::now())))?;
            if bytes.is_empty() {
                break;
            }
            self.take(&bytes)?;
        }
        Ok(self.arrived.pop_front())
    }

    /// Takes the frames out of what came over the line.
    fn take(&mut self, bytes: &[u8]) -> Result<(), HostError> {
        for byte in bytes {
            let reply = match self.receiver.push(*byte) {
                None => continue,
                Some(Ok(frame)) => frame.decode().map(|reply| (frame.header.sequence, reply)),
                Some(Err(error)) => Err(error),
            };
            match reply {
                Ok(reply) => self.arrived.push_back(reply),
                Err(error) => return Err(self.give_up(&format!("sent a damaged reply ({error:?})"))),
            }
        }
        Ok(())
    }

    fn ask(&mut self, request: &Request) -> Result<Reply, HostError> {
        let mut answer = None;
        self.ask_all(std::iter::once(Ok(request.clone())), |reply| {
            answer = Some(reply);
            Ok(())
        })?;
        answer.ok_or_else(|| HostError::Failed("the flight computer did not reply".to_owned()))
    }

    /// Asks everything, several requests under way at a time, and passes on the replies in the order of the requests.
    fn ask_all(
        &mut self,
        mut requests: impl Iterator<Item = Result<Request, HostError>>,
        mut take: impl FnMut(Reply) -> Result<(), HostError>,
    ) -> Result<(), HostError> {
        let mut under_way = UnderWay::default();
        let mut tries = 1;
        loop {
            while under_way.len() < WINDOW {
                let Some(request) = requests.next() else { break };
                self.last_sequence = next_sequence(self.last_sequence);
                under_way.push(self.last_sequence, request?);
                self.send_requests(under_way.newest())?;
            }
            if under_way.len() == 0 {
                return Ok(());
            }
            match self.next_reply(PATIENCE)? {
                // A reply to nothing under way: the second one to a request that was sent twice, or an error frame.
                Some((sequence, _)) if !under_way.holds(sequence) => continue,
                Some((_, Reply::Frame(Err(FrameRefusal::OutOfOrder { expected })))) => {
                    self.fill_gap(&mut under_way, expected)?;
                }
                Some((sequence, reply)) => {
                    tries = 1;
                    under_way.answer(sequence, reply);
                    while let Some(reply) = under_way.next_answered() {
                        take(reply)?;
                    }
                }
                None if tries < TRIES => {
                    tries += 1;
                    self.send_again(under_way.unanswered())?;
                }
                None => return Err(self.give_up("does not answer")),
            }
        }
    }

    /// A request was lost, and the computer refuses all frames behind it: they are sent again from there, once.
    fn fill_gap(&mut self, under_way: &mut UnderWay, expected: u16) -> Result<(), HostError> {
        if !under_way.holds(expected) {
            return Err(self.give_up("took a frame whose reply was lost: the estimates cannot be completed"));
        }
        if under_way.is_first_notice_of(expected) {
            self.send_again(under_way.from(expected))?;
        }
        Ok(())
    }

    fn send_requests<'a>(&mut self, requests: impl Iterator<Item = (u16, &'a Request)>) -> Result<(), HostError> {
        for (sequence, request) in requests {
            let bytes = self.buffer.encode(Header::new(sequence), request);
            let bytes =
                bytes.map_err(|error| HostError::Failed(format!("a request does not fit its frame: {error:?}")))?;
            let bytes = bytes.to_vec();
            self.send_bytes(&bytes)?;
        }
        Ok(())
    }

    /// Sends what is under way once more, after a delimiter that ends whatever the line has swallowed.
    fn send_again<'a>(&mut self, requests: impl Iterator<Item = (u16, &'a Request)>) -> Result<(), HostError> {
        self.send_bytes(&[0])?;
        self.send_requests(requests)
    }

    fn with_line<R>(
        &mut self,
        action: impl FnOnce(&mut Box<dyn Line>) -> Result<R, HostError>,
    ) -> Result<R, HostError> {
        let line = self.line.as_mut().ok_or_else(|| HostError::Failed("the flight computer has ended".to_owned()))?;
        action(line).map_err(|error| self.give_up(&error.to_string()))
    }

    /// Ends the computer, with its last words.
    fn give_up(&mut self, reason: &str) -> HostError {
        let last_words = self.line.take().map(Line::post_mortem).unwrap_or_default();
        HostError::Failed(format!("the flight computer {reason}: {last_words}"))
    }
}

fn unexpected(reply: &Reply) -> HostError {
    HostError::Failed(format!("the flight computer gave another kind of reply than was asked for: {reply:?}"))
}
