//! What a line that loses messages does to sensor frames: nothing, or an error.

use std::time::Duration;

use kapvik_firmware::pipeline::FrameEstimate;
use kapvik_firmware::sensor_frame::SensorFrame;

use super::in_process::InProcess;
use super::{FlightComputer, Line};
use crate::error::HostError;
use crate::qemu::LogLine;

/// A line to this process that loses what is sent or received at these counts, from 0.
struct Lossy {
    line: InProcess,
    requests: &'static [usize],
    replies: &'static [usize],
    sent: usize,
    received: usize,
}

impl Line for Lossy {
    fn send(&mut self, bytes: &[u8]) -> Result<(), HostError> {
        let lost = self.requests.contains(&self.sent);
        self.sent += 1;
        if lost { Ok(()) } else { self.line.send(bytes) }
    }

    fn receive(&mut self, patience: Duration) -> Result<Vec<u8>, HostError> {
        let bytes = self.line.receive(patience)?;
        let lost = self.replies.contains(&self.received);
        self.received += 1;
        Ok(if lost { Vec::new() } else { bytes })
    }

    fn into_log(self: Box<Self>) -> Vec<LogLine> {
        Vec::new()
    }

    fn post_mortem(self: Box<Self>) -> String {
        "it was lossy".to_owned()
    }
}

fn computer(requests: &'static [usize], replies: &'static [usize]) -> FlightComputer {
    let lossy = Lossy { line: InProcess::boot(), requests, replies, sent: 0, received: 0 };
    FlightComputer::greet(Box::new(lossy), None).expect("the greeting is not lost")
}

fn estimates(computer: &mut FlightComputer, count: u64) -> Result<Vec<FrameEstimate>, HostError> {
    let frames = (0..count).map(|number| {
        let accel = kapvik_firmware::rover::Axes { x: Some(0.01 * number as f32), y: Some(0.0), z: Some(9.8) };
        Ok(SensorFrame { time_us: 100_000 * number, accel_m_s2: accel, ..SensorFrame::default() })
    });
    let mut estimates = Vec::new();
    computer.frames(frames, |estimate| {
        estimates.push(estimate);
        Ok(())
    })?;
    Ok(estimates)
}

#[test]
fn frames_that_are_lost_on_the_way_are_sent_again() {
    const COUNT: u64 = 60;
    let expected = estimates(&mut computer(&[], &[]), COUNT).expect("nothing is lost");
    assert_eq!(expected.len() as u64, COUNT);
    // Counted from the greeting: the first, two in a row, several, the last.
    for lost in [&[1][..], &[9, 10], &[20, 37, 55], &[60]] {
        let mut computer = computer(lost, &[]);
        let found = estimates(&mut computer, COUNT).expect("what is lost is sent again");
        assert!(found == expected, "without the messages {lost:?}");
        assert_eq!(u64::from(computer.health().expect("an answer").frames_taken), COUNT, "none is taken twice");
    }
}

#[test]
fn a_lost_reply_is_asked_for_again() {
    let expected = estimates(&mut computer(&[], &[]), 1).expect("nothing is lost");
    let mut computer = computer(&[], &[1]);
    assert!(estimates(&mut computer, 1).expect("the reply is repeated") == expected);
    assert_eq!(computer.health().expect("an answer").frames_taken, 1);
}

#[test]
fn replies_that_cannot_be_had_again_are_an_error() {
    let error = estimates(&mut computer(&[], &[1]), 40).expect_err("sixteen replies are lost, one is remembered");
    assert!(error.to_string().contains("reply was lost"), "{error}");
}
