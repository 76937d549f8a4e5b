//! A recorded drive through the flight pipeline: the same bits in QEMU and on the host, and as they were.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use kapvik_firmware::checksum::Checksum;
use kapvik_host::flight_computer::FlightComputer;
use kapvik_tests::{estimates_of_the_recorded_drive, flight_computer};

/// Set, this variable makes the test write what it should compare: after a change that is meant to change estimates.
const BLESS: &str = "KAPVIK_BLESS";
/// Of the rows of estimates each so-manieth is kept to be read in a review; the checksum is over all.
const KEPT: usize = 10;

static ON_THE_HOST: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let mut computer = FlightComputer::in_process().expect("the library answers in this process");
    estimates_of_the_recorded_drive(&mut computer)
});

/// The header, each tenth row, and a last line with the checksum over all bytes.
fn indication(estimates: &[u8]) -> String {
    let text = std::str::from_utf8(estimates).expect("estimates are text");
    let (header, rows) = text.split_once('\n').expect("estimates have a header");
    let kept: Vec<&str> = std::iter::once(header).chain(rows.lines().step_by(KEPT)).collect();
    format!("{}\n{:08x}\n", kept.join("\n"), Checksum::of(estimates))
}

/// The first field that differs, with its column's name.
fn first_difference(expected: &str, found: &str) -> String {
    let names: Vec<&str> = found.lines().next().unwrap_or("").split(',').collect();
    for (number, (expected, found)) in expected.lines().zip(found.lines()).enumerate() {
        for (place, (expected, found)) in expected.split(',').zip(found.split(',')).enumerate() {
            if expected != found {
                let name = names.get(place).unwrap_or(&"");
                return format!("line {}, {name}: {expected} before, {found} now", number + 1);
            }
        }
    }
    "the number of rows or columns".to_owned()
}

#[test]
fn qemu_and_host_write_the_same_estimates() {
    let mut image = flight_computer();
    let in_qemu = estimates_of_the_recorded_drive(&mut image);
    let on_host = &*ON_THE_HOST;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(in_qemu == *on_host, "{}", first_difference(&text(on_host), &text(&in_qemu)));
    let health = image.health().expect("the image is well");
    assert_eq!((health.link.refused(), health.link.sequence_gaps, health.link.replies_lost), (0, 0, 0));
    assert_eq!(u64::from(health.frames_taken), on_host.iter().filter(|byte| **byte == b'\n').count() as u64 - 1);
    let dropped = image.estimator_health().expect("the image is well").sensors;
    let log = image.into_log();
    let logged = |words: &str| log.iter().any(|line| line.text.contains(words));
    assert!(logged("rover configured"), "{log:?}");
    let out_of_use = dropped.iter().any(|sensor| sensor.dropped || sensor.on_probation > 0);
    assert_eq!(logged("sensor dropped"), out_of_use, "{log:?}");
}

#[test]
fn the_estimates_are_what_they_were() {
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("replay/estimates.csv");
    let found = indication(&ON_THE_HOST);
    if std::env::var_os(BLESS).is_some() {
        std::fs::write(&path, &found).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    }
    let expected = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let difference = || first_difference(&expected, &found);
    assert!(
        expected == found,
        "{}\nif that is meant: {BLESS}=1 cargo test --release -p kapvik-tests --test replay",
        difference()
    );
}
