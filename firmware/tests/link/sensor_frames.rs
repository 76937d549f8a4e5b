//! Sensor frames over the link: each is taken once, in order, whatever is lost or sent again.

use kapvik_firmware::estimator::EstimatorHealth;
use kapvik_firmware::link::{
    FrameBuffer, FrameReceiver, FrameRefusal, Header, Reply, Request, RoverSource, next_sequence,
};
use kapvik_firmware::pipeline::Pipeline;
use kapvik_firmware::rover::{GeometryError, Rover};
use kapvik_firmware::sensor_frame::SensorFrame;
use kapvik_firmware::telemetry::{Board, Telemetry};

use crate::encode;
use crate::port::Port;

struct NoBoard;

impl Board for NoBoard {
    fn stack_high_water_bytes(&mut self) -> Option<u32> {
        None
    }
}

/// A flight computer, and how many requests it was sent.
struct Computer(Telemetry<Port, NoBoard>);

impl Computer {
    fn greeted() -> Self {
        let mut computer = Self(Telemetry::new(Port::default(), NoBoard));
        computer.0.start();
        assert!(matches!(computer.ask(1, &Request::Hello), Reply::Boot(_)));
        computer
    }

    fn ask(&mut self, sequence: u16, request: &Request) -> Reply {
        let bytes = self.ask_for_bytes(sequence, request);
        let mut receiver = FrameReceiver::new();
        let frames: Vec<(u16, Reply)> = bytes
            .iter()
            .filter_map(|byte| match receiver.push(*byte) {
                Some(Ok(frame)) => Some((frame.header.sequence, frame.decode().expect("a reply"))),
                Some(Err(error)) => panic!("{error:?}"),
                None => None,
            })
            .collect();
        let [(answered, reply)] = frames.as_slice() else { panic!("{} replies", frames.len()) };
        assert_eq!(*answered, sequence);
        reply.clone()
    }

    fn ask_for_bytes(&mut self, sequence: u16, request: &Request) -> Vec<u8> {
        self.0.port().input.extend(encode(sequence, request));
        while !self.0.port().input.is_empty() {
            self.0.serve();
        }
        std::mem::take(&mut self.0.port().output)
    }

    fn estimator_health(&mut self, sequence: u16) -> EstimatorHealth {
        match self.ask(sequence, &Request::EstimatorHealth) {
            Reply::EstimatorHealth(health) => health,
            other => panic!("{other:?}"),
        }
    }
}

fn frame(number: u64) -> Request {
    Request::Frame(sensors(number))
}

fn sensors(number: u64) -> SensorFrame {
    SensorFrame { time_us: 50_000 * number, rocker_angle_rad: Some(0.001 * number as f32), ..SensorFrame::default() }
}

#[test]
fn frames_over_the_link_are_frames_through_the_pipeline() {
    let mut computer = Computer::greeted();
    let mut pipeline = Pipeline::new(&Rover::assumed()).expect("the assumed rover can be");
    for number in 1..=50 {
        let reply = Reply::Frame(Ok(*pipeline.tick(&sensors(number))));
        let sequence = 1 + number as u16;
        let mut buffer = FrameBuffer::new();
        let expected = buffer.encode(Header::new(sequence), &reply).expect("an estimate fits");
        assert_eq!(computer.ask_for_bytes(sequence, &frame(number)), expected);
    }
    assert_eq!(computer.estimator_health(52), *pipeline.health());
}

#[test]
fn a_frame_sent_again_is_answered_the_same_and_taken_once() {
    let mut computer = Computer::greeted();
    computer.ask(2, &frame(1));
    let first = computer.ask_for_bytes(3, &frame(2));
    // Noise on the line in between, which is answered, changes nothing.
    computer.0.port().input.extend([9, 9, 9, 0]);
    while !computer.0.port().input.is_empty() {
        computer.0.serve();
    }
    assert!(!std::mem::take(&mut computer.0.port().output).is_empty());
    for _ in 0..3 {
        assert_eq!(computer.ask_for_bytes(3, &frame(2)), first);
    }
    assert!(matches!(computer.ask(4, &frame(3)), Reply::Frame(Ok(_))));
    assert_eq!(computer.estimator_health(5).frames, 3);
    match computer.ask(6, &Request::Health) {
        Reply::Health(health) => assert_eq!(health.frames_taken, 3),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_frame_after_a_gap_waits_until_the_gap_is_filled() {
    let mut computer = Computer::greeted();
    computer.ask(2, &frame(1));
    // Number 3 was lost: what follows is refused, and says what is waited for.
    for late in [4, 5, 6] {
        let refused = Reply::Frame(Err(FrameRefusal::OutOfOrder { expected: 3 }));
        assert_eq!(computer.ask(late, &frame(u64::from(late) - 1)), refused);
    }
    for number in 3..=6 {
        assert!(matches!(computer.ask(number, &frame(u64::from(number) - 1)), Reply::Frame(Ok(_))));
    }
    // A frame from before the last one is neither taken nor answered from memory.
    assert_eq!(computer.ask(4, &frame(3)), Reply::Frame(Err(FrameRefusal::OutOfOrder { expected: 7 })));
    assert_eq!(computer.estimator_health(7).frames, 5);
}

/// A question between two frames is asked again since its answer was lost: the frame after it is waited for, and then the next is in order.
#[test]
fn an_old_question_that_is_asked_again_does_not_hold_up_the_frames() {
    let mut computer = Computer::greeted();
    computer.ask(2, &frame(1));
    let _ = computer.ask(3, &Request::Health);
    assert!(matches!(computer.ask(4, &frame(2)), Reply::Frame(Ok(_))));
    let _ = computer.ask(3, &Request::Health);
    assert_eq!(computer.ask(5, &frame(3)), Reply::Frame(Err(FrameRefusal::OutOfOrder { expected: 4 })));
    assert!(matches!(computer.ask(4, &frame(2)), Reply::Frame(Ok(_))));
    assert!(matches!(computer.ask(5, &frame(3)), Reply::Frame(Ok(_))));
    assert_eq!(computer.estimator_health(6).frames, 3);
}

#[test]
fn nothing_is_estimated_before_the_start() {
    let mut computer = Computer(Telemetry::new(Port::default(), NoBoard));
    match computer.ask(1, &Request::Hello) {
        Reply::Boot(report) => assert!(!report.self_test.passed() && report.rover.is_none(), "{report:?}"),
        other => panic!("{other:?}"),
    }
    assert_eq!(computer.ask(2, &frame(1)), Reply::Frame(Err(FrameRefusal::NoRover)));
    assert_eq!(computer.ask(3, &Request::Configure(Rover::assumed())), Reply::Configured(Ok(())));
    assert_eq!(computer.ask(4, &frame(1)), Reply::Frame(Err(FrameRefusal::SelfTestFailed)));
}

#[test]
fn hello_starts_the_numbers_anew_but_not_the_estimates() {
    let mut computer = Computer::greeted();
    computer.ask(2, &frame(1));
    computer.ask(1, &Request::Hello);
    // The number of the last frame, but another frame.
    computer.ask(2, &frame(2));
    assert_eq!(computer.estimator_health(3).frames, 2);
}

#[test]
fn numbers_go_on_past_their_end() {
    let mut computer = Computer::greeted();
    computer.ask(u16::MAX, &Request::Health);
    assert!(matches!(computer.ask(next_sequence(u16::MAX), &frame(1)), Reply::Frame(Ok(_))));
}

#[test]
fn a_rover_is_configured_or_refused_with_its_reason() {
    let mut computer = Computer::greeted();
    let source = |computer: &mut Computer| match computer.ask(1, &Request::Hello) {
        Reply::Boot(report) => report.rover,
        other => panic!("{other:?}"),
    };
    assert_eq!(source(&mut computer), Some(RoverSource::Assumed));
    computer.ask(2, &frame(1));
    let mut impossible = Rover::assumed();
    impossible.mass_kg = 0.0;
    let refused = Reply::Configured(Err(GeometryError::Weight));
    assert_eq!(computer.ask(3, &Request::Configure(impossible)), refused);
    assert_eq!(computer.estimator_health(4).frames, 1, "a refused rover changes nothing");
    let mut heavier = Rover::assumed();
    heavier.mass_kg = 50.0;
    assert_eq!(computer.ask(5, &Request::Configure(heavier)), Reply::Configured(Ok(())));
    assert_eq!(computer.estimator_health(6).frames, 0, "another rover is estimated anew");
    assert_eq!(source(&mut computer), Some(RoverSource::Configured));
}
