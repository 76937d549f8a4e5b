//! The link, from bytes to messages and back.

mod damaged;
mod longest;
mod port;
mod sensor_frames;

use damaged::{damaged, frame_around};
use kapvik_firmware::link::{
    FrameBuffer, FrameReceiver, Header, Incoming, Link, LinkError, LinkHealth, NO_SEQUENCE, Reply, Request,
    next_sequence,
};
use kapvik_firmware::rover::{Axes, PerAxle, PerSide, Rover};
use kapvik_firmware::sensor_frame::{SensorFrame, WheelSensors};
use kapvik_firmware::soil::{QueryAnswer, Refusal};
use kapvik_firmware::terramechanics::Wheel;
use kapvik_firmware::wheel_state::{Slope, SoilQuery, WheelNoise, WheelState};
use port::Port;
use proptest::num;
use proptest::prelude::*;

/// `Hello` with number 1: version 2, number 1, variant 0; their CRC-32 by zlib, 0xe5de3c3d; byte stuffing by hand.
const HELLO: [u8; 9] = [0x03, 0x02, 0x01, 0x05, 0x3d, 0x3c, 0xde, 0xe5, 0x00];

/// What a link makes of these bytes: each frame that arrived, and the counters.
fn receive(bytes: &[u8]) -> (Vec<Incoming>, LinkHealth) {
    let mut link = Link::new(Port::default());
    link.port().input.extend(bytes);
    let mut frames = Vec::new();
    while !link.port().input.is_empty() {
        frames.extend(link.receive());
    }
    (frames, link.health())
}

fn reasons(bytes: &[u8]) -> Vec<Option<LinkError>> {
    receive(bytes).0.into_iter().map(|incoming| incoming.request.err()).collect()
}

fn encode(sequence: u16, request: &Request) -> Vec<u8> {
    FrameBuffer::new().encode(Header::new(sequence), request).expect("a request fits").to_vec()
}

#[test]
fn the_wire_format_is_as_documented() {
    assert_eq!(encode(1, &Request::Hello), HELLO);
    assert_eq!(receive(&HELLO).0, [Incoming { sequence: 1, request: Ok(Request::Hello) }]);
}

#[test]
fn each_damage_has_its_reason() {
    let more = [
        (LinkError::Short, vec![1, 0]),
        (LinkError::Version, frame_around(&[1, 1, 0])),
        (LinkError::Undecodable, frame_around(&[2, 1, 200])),
        // One byte too many after a whole message.
        (LinkError::Undecodable, frame_around(&[2, 1, 0, 9])),
    ];
    for (reason, bytes) in damaged().into_iter().chain(more) {
        let followed: Vec<u8> = bytes.iter().chain(&HELLO).copied().collect();
        assert_eq!(reasons(&followed), [Some(reason), None]);
        assert_eq!(receive(&followed).1.refused(), 1);
    }
}

#[test]
fn a_number_that_could_be_read_is_repeated() {
    let (frames, _) = receive(&frame_around(&[2, 9, 200]));
    assert_eq!(frames, [Incoming { sequence: 9, request: Err(LinkError::Undecodable) }]);
    let (frames, _) = receive(&[3, 1, 1, 0]);
    assert_eq!(frames, [Incoming { sequence: NO_SEQUENCE, request: Err(LinkError::Short) }]);
}

#[test]
fn gaps_and_duplicates_are_counted() {
    let bytes: Vec<u8> = [1, 2, 2, 3, 7, 8].iter().flat_map(|number| encode(*number, &Request::Health)).collect();
    let health = receive(&bytes).1;
    assert_eq!((health.frames_ok, health.duplicates, health.sequence_gaps), (6, 1, 1));
    let bytes: Vec<u8> = [(5, Request::Health), (1, Request::Hello), (2, Request::Health)]
        .iter()
        .flat_map(|(number, request)| encode(*number, request))
        .collect();
    assert_eq!(receive(&bytes).1.sequence_gaps, 0, "Hello starts the numbers anew");
}

#[test]
fn numbers_wrap_around_without_the_reserved_one() {
    assert_eq!(next_sequence(NO_SEQUENCE), 1);
    assert_eq!(next_sequence(u16::MAX), 1);
}

#[test]
fn empty_frames_mean_nothing() {
    let bytes: Vec<u8> = [0, 0, 0].iter().chain(&HELLO).chain(&[0, 0]).copied().collect();
    assert_eq!(reasons(&bytes), [None]);
}

fn any_state() -> impl Strategy<Value = WheelState> {
    let number = || num::f32::ANY;
    (number(), number(), number(), number(), proptest::option::of(number())).prop_map(
        |(drawbar_pull_n, load_n, torque_nm, slip, sinkage_m)| WheelState {
            drawbar_pull_n,
            load_n,
            torque_nm,
            slip,
            sinkage_m,
        },
    )
}

fn any_request() -> impl Strategy<Value = Request> {
    let query = (proptest::collection::vec(any_state(), 0..=6), 0.0_f32..1.0, 0.0_f32..10.0).prop_map(
        |(states, size, sigma)| {
            Request::Estimate(SoilQuery {
                wheel: Wheel { radius_m: size, width_m: size },
                noise: WheelNoise {
                    drawbar_pull_n: sigma,
                    load_n: sigma,
                    torque_nm: sigma,
                    slip: sigma,
                    sinkage_m: sigma,
                },
                slope: (size > 0.5).then_some(Slope { angle_rad: sigma, std_rad: size }),
                wheels: states.into_iter().collect(),
            })
        },
    );
    let number = || proptest::option::of(num::f32::ANY);
    let frame = (any::<u64>(), number(), number()).prop_map(|(time_us, one, two)| {
        let wheel = WheelSensors { rate_rad_s: one, motor_torque_nm: two, load_cell_n: one };
        Request::Frame(SensorFrame {
            time_us,
            wheels: PerSide::both(PerAxle::all(wheel)),
            bogie_angle_rad: PerSide { left: one, right: two },
            rocker_angle_rad: two,
            accel_m_s2: Axes { x: one, y: two, z: one },
            ..SensorFrame::default()
        })
    });
    let others = [Request::Hello, Request::Health, Request::SelfTest, Request::EstimatorHealth];
    prop_oneof![query, frame, proptest::sample::select(others.to_vec()), Just(Request::Configure(Rover::assumed()))]
}

proptest! {
    #[test]
    fn requests_arrive_as_sent(requests in proptest::collection::vec((any::<u16>(), any_request()), 1..8)) {
        let bytes: Vec<u8> = requests.iter().flat_map(|(number, request)| encode(*number, request)).collect();
        let received = receive(&bytes).0;
        // Not a number is unequal to itself: what is compared is how requests are written, and their bytes.
        let arrived: Vec<_> = received.iter().map(|incoming| (incoming.sequence, incoming.request.as_ref().ok())).collect();
        let sent: Vec<_> = requests.iter().map(|(number, request)| (*number, Some(request))).collect();
        prop_assert_eq!(format!("{arrived:?}"), format!("{sent:?}"));
        let again: Vec<u8> =
            arrived.iter().flat_map(|(number, request)| encode(*number, request.expect("it is well"))).collect();
        prop_assert_eq!(again, bytes);
    }

    #[test]
    fn refusals_arrive_as_sent(number: u16, wheels in 0_usize..=6) {
        let reply = Reply::Estimate(QueryAnswer::refused(wheels, Refusal::NotFinite));
        let mut buffer = FrameBuffer::new();
        let bytes = buffer.encode(Header::new(number), &reply).expect("a refusal fits").to_vec();
        let mut receiver = FrameReceiver::new();
        let (last, rest) = bytes.split_last().expect("a frame has a delimiter");
        for byte in rest {
            prop_assert!(receiver.push(*byte).is_none());
        }
        let frame = receiver.push(*last).expect("the delimiter ends the frame").expect("the frame is whole");
        prop_assert_eq!(frame.header, Header::new(number));
        prop_assert_eq!(frame.decode::<Reply>(), Ok(reply));
    }

    #[test]
    fn a_good_frame_is_understood_after_any_garbage(garbage in proptest::collection::vec(any::<u8>(), 0..3000)) {
        let bytes: Vec<u8> = garbage.iter().copied().chain([0]).chain(HELLO).collect();
        let (frames, health) = receive(&bytes);
        prop_assert_eq!(frames.last(), Some(&Incoming { sequence: 1, request: Ok(Request::Hello) }));
        prop_assert_eq!(frames.len() as u32, health.frames_ok + health.refused());
    }

    #[test]
    fn a_damaged_frame_is_never_taken_for_a_good_one(request in any_request(), place: prop::sample::Index, flip in 1_u8..) {
        let good = encode(1, &request);
        let mut bad = good.clone();
        let place = place.index(good.len());
        bad[place] ^= flip;
        bad.push(0);
        for received in receive(&bad).0 {
            prop_assert!(received.request.is_err(), "byte {} of {:?} damaged, taken as {:?}", place, request, received);
        }
    }
}
