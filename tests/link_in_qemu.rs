//! The flight image's link under fire: what is bad is counted, answered with its reason, and changes nothing else.

#[path = "../firmware/tests/link/damaged.rs"]
mod damaged;

use std::time::Duration;

use damaged::damaged;
use kapvik_firmware::link::{FrameBuffer, Header, HealthReport, LinkError, NO_SEQUENCE, Reply, Request};
use kapvik_host::flight_computer::FlightComputer;
use kapvik_tests::{bits, flight_computer, noise_bytes, queries, random};

/// Far longer than a reply takes.
const PATIENCE: Duration = Duration::from_secs(20);

fn refused(health: &HealthReport, reason: LinkError) -> u32 {
    match reason {
        LinkError::Oversized => health.link.oversized,
        LinkError::Cut => health.link.cut,
        LinkError::Short => health.link.short,
        LinkError::Checksum => health.link.checksum,
        LinkError::Version => health.link.version,
        LinkError::Undecodable => health.link.undecodable,
    }
}

#[test]
fn each_kind_of_damage_is_answered_and_counted() {
    const TIMES: u32 = 5;
    let mut computer = flight_computer();
    for _ in 0..TIMES {
        for (reason, bytes) in damaged() {
            computer.send_bytes(&bytes).expect("the image listens");
            let (sequence, reply) = computer.next_reply(PATIENCE).expect("the line holds").expect("an error frame");
            assert_eq!(reply, Reply::Error(reason));
            assert_eq!(sequence, if reason == LinkError::Undecodable { 9 } else { NO_SEQUENCE });
        }
    }
    let health = computer.health().expect("the image is well");
    for (reason, _) in damaged() {
        assert_eq!(refused(&health, reason), TIMES, "{reason:?}: {health:?}");
    }
    assert_eq!(health.link.refused(), TIMES * damaged().len() as u32);
    let log = computer.into_log();
    assert_eq!(log.iter().filter(|line| line.level == "warn").count() as u32, health.link.refused(), "{log:?}");
}

#[test]
fn a_request_sent_twice_is_answered_twice() {
    let mut computer = flight_computer();
    let frame = FrameBuffer::new().encode(Header::new(400), &Request::Health).expect("a request fits").to_vec();
    for _ in 0..2 {
        computer.send_bytes(&frame).expect("the image listens");
        let (sequence, reply) = computer.next_reply(PATIENCE).expect("the line holds").expect("a reply");
        assert_eq!(sequence, 400);
        assert!(matches!(reply, Reply::Health(_)), "{reply:?}");
    }
    let health = computer.health().expect("the image is well");
    assert_eq!(health.link.duplicates, 1);
    // From the greeting to 400, and back to the host's own numbers.
    assert_eq!(health.link.sequence_gaps, 2);
}

/// The next replies, as many as are expected.
fn replies(computer: &mut FlightComputer, count: usize) -> Vec<(u16, Reply)> {
    let next = |_| computer.next_reply(PATIENCE).expect("the line holds").expect("another reply");
    (0..count).map(next).collect()
}

#[test]
fn noise_is_refused_as_on_the_host_and_disturbs_no_estimate() {
    let mut random = random(30);
    let mut host = FlightComputer::in_process().expect("the library answers in this process");
    let mut target = flight_computer();
    for round in 0..6 {
        let mut bytes = noise_bytes(6000, &mut random);
        if round % 2 == 1 {
            // Without delimiters: longer than any frame.
            bytes.iter_mut().for_each(|byte| *byte = (*byte).max(1));
        }
        bytes.push(0);
        host.send_bytes(&bytes).expect("the library listens");
        target.send_bytes(&bytes).expect("the image listens");
        let expected: Vec<_> = std::iter::from_fn(|| host.next_reply(PATIENCE).expect("the line holds")).collect();
        assert!(!expected.is_empty());
        assert_eq!(replies(&mut target, expected.len()), expected);
        for query in queries(10, &mut random) {
            let answer = target.query(&query).expect("the image answers");
            assert_eq!(bits(&answer), bits(&host.query(&query).expect("the library answers")));
        }
    }
    let (target, host) = (target.health().expect("the image is well"), host.health().expect("the library is well"));
    assert_eq!(target.link, host.link);
    assert_eq!(target.queries_answered, 60, "the image was not reset");
}
