//! Frames that are damaged.

use kapvik_firmware::checksum::Checksum;
use kapvik_firmware::link::{FrameBuffer, Header, LinkError, PAYLOAD_CAPACITY, Request};

/// A frame with a right checksum around a content that is not long; stuffed by hand: each run between zeros behind its length and one.
pub fn frame_around(content: &[u8]) -> Vec<u8> {
    let payload = [content, &Checksum::of(content).to_le_bytes()].concat();
    assert!(payload.len() < 254, "a run of the stuffing is no longer");
    let stuffed = payload.split(|byte| *byte == 0).flat_map(|run| [&[run.len() as u8 + 1], run].concat());
    stuffed.chain([0]).collect()
}

/// One frame of each kind of damage; of these the one that cannot be decoded has a number that can be read, 9.
pub fn damaged() -> [(LinkError, Vec<u8>); 6] {
    let whole = FrameBuffer::new().encode(Header::new(1), &Request::Health).expect("a request fits").to_vec();
    let cut = [&whole[..whole.len() - 3], &[0]].concat();
    let mut checksum = whole;
    checksum[5] ^= 0x40;
    [
        (LinkError::Checksum, checksum),
        (LinkError::Cut, cut),
        (LinkError::Oversized, [vec![0x55; PAYLOAD_CAPACITY * 4], vec![0]].concat()),
        (LinkError::Short, vec![3, 1, 1, 0]),
        (LinkError::Version, frame_around(&[77, 1, 1])),
        (LinkError::Undecodable, frame_around(&[2, 9, 99])),
    ]
}
