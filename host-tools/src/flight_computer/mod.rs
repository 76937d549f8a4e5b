//! The flight computer as the host talks to it, in this process or in QEMU: the same messages on the same link.

mod in_process;
mod in_qemu;

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use clap::ValueEnum;
use kapvik_firmware::link::{
    BootReport, FrameBuffer, FrameReceiver, Header, HealthReport, NO_SEQUENCE, Reply, Request, next_sequence,
};
use kapvik_firmware::self_test::SelfTestReport;
use kapvik_firmware::soil::QueryAnswer;
use kapvik_firmware::wheel_state::SoilQuery;

use crate::error::HostError;
use crate::qemu::{Binary, Clock, Image, LogLine, LogView, Machine};
use crate::setup::{self, Toolchain};

use in_process::InProcess;
use in_qemu::InQemu;

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
    /// What the computer has logged.
    fn log(&self) -> Vec<LogLine>;
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
}

impl FlightComputer {
    /// The flight library in this process.
    ///
    /// # Errors
    /// Where it does not answer.
    pub fn in_process() -> Result<Self, HostError> {
        Self::greet(Box::new(InProcess::boot()))
    }

    /// The flight image in QEMU. Its log is shown on standard error as far as `view` says.
    ///
    /// # Errors
    /// Where QEMU does not start, or the image does not answer.
    pub fn in_qemu(toolchain: &Toolchain, image: &Image, view: LogView) -> Result<Self, HostError> {
        Self::greet(Box::new(InQemu::connect(Machine::start(toolchain, image, Clock::Wall, view)?)?))
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

    fn greet(line: Box<dyn Line>) -> Result<Self, HostError> {
        let mut computer = Self {
            line: Some(line),
            receiver: FrameReceiver::new(),
            buffer: FrameBuffer::new(),
            last_sequence: NO_SEQUENCE,
            arrived: VecDeque::new(),
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

    /// As [`Self::query`] for many, several under way at a time. `progress` hears how many are answered.
    ///
    /// # Errors
    /// Where the computer does not answer.
    pub fn query_all(
        &mut self,
        queries: &[SoilQuery],
        progress: impl FnMut(usize),
    ) -> Result<Vec<QueryAnswer>, HostError> {
        let requests: Vec<Request> = queries.iter().cloned().map(Request::Estimate).collect();
        let replies = self.ask_all(&requests, progress)?;
        let answers = replies.into_iter().map(|reply| match reply {
            Reply::Estimate(answer) => Ok(answer),
            other => Err(unexpected(&other)),
        });
        answers.collect()
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

    /// What the computer has logged so far; nothing where it runs in this process.
    pub fn log(&self) -> Vec<LogLine> {
        self.line.as_ref().map(|line| line.log()).unwrap_or_default()
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
        let mut replies = self.ask_all(std::slice::from_ref(request), |_| ())?;
        replies.pop().ok_or_else(|| HostError::Failed("the flight computer did not reply".to_owned()))
    }

    /// Asks everything, several requests under way at a time, and gives the replies in the order of the requests.
    fn ask_all(&mut self, requests: &[Request], mut progress: impl FnMut(usize)) -> Result<Vec<Reply>, HostError> {
        let mut replies: Vec<Option<Reply>> = requests.iter().map(|_| None).collect();
        let mut under_way: VecDeque<(u16, usize)> = VecDeque::new();
        let mut waiting = requests.iter().enumerate();
        let (mut done, mut tries) = (0, 1);
        while done < requests.len() {
            while under_way.len() < WINDOW {
                let Some((index, request)) = waiting.next() else { break };
                self.last_sequence = next_sequence(self.last_sequence);
                self.send_request(self.last_sequence, request)?;
                under_way.push_back((self.last_sequence, index));
            }
            match self.next_reply(PATIENCE)? {
                Some((sequence, reply)) => {
                    // A reply to nothing under way: the second one to a request that was sent twice, or an error frame.
                    let Some(place) = under_way.iter().position(|(sent, _)| *sent == sequence) else { continue };
                    let slot = under_way.remove(place).and_then(|(_, index)| replies.get_mut(index));
                    slot.into_iter().for_each(|slot| *slot = Some(reply.clone()));
                    (done, tries) = (done + 1, 1);
                    progress(done);
                }
                None if tries < TRIES => {
                    tries += 1;
                    self.send_again(requests, &under_way)?;
                }
                None => return Err(self.give_up("does not answer")),
            }
        }
        Ok(replies.into_iter().flatten().collect())
    }

    fn send_request(&mut self, sequence: u16, request: &Request) -> Result<(), HostError> {
        let bytes = self.buffer.encode(Header::new(sequence), request);
        let bytes = bytes.map_err(|error| HostError::Failed(format!("a request does not fit its frame: {error:?}")))?;
        let bytes = bytes.to_vec();
        self.send_bytes(&bytes)
    }

    /// Sends what is under way once more, after a delimiter that ends whatever the line has swallowed.
    fn send_again(&mut self, requests: &[Request], under_way: &VecDeque<(u16, usize)>) -> Result<(), HostError> {
        self.send_bytes(&[0])?;
        for (sequence, index) in under_way {
            if let Some(request) = requests.get(*index) {
                self.send_request(*sequence, request)?;
            }
        }
        Ok(())
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
