//! Standard output that cannot be written.

#![cfg(target_os = "linux")]

mod kapvik;

use std::fs::File;
use std::process::Stdio;

use kapvik::kapvik;

#[test]
fn a_full_disk_is_one_line_and_no_panic() {
    let full = File::options().write(true).open("/dev/full").expect("the device that is always full");
    let output = kapvik().arg("soils").stdout(Stdio::from(full)).output().expect("started");
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8(output.stderr).expect("text");
    assert_eq!(said.lines().count(), 1, "{said}");
    assert!(said.starts_with("kapvik: standard output could not be written: "), "{said}");
}
