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

#[test]
fn what_a_program_reads_there_stays_alone() {
    let identify = ["identify", "ding2011-smooth", "--method", "map", "--json", "/dev/stdout"];
    let output = kapvik().args(identify).output().expect("started");
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON and nothing else");
    assert_eq!(document["method"], "map");
    assert!(
        String::from_utf8(output.stderr).expect("text").contains("no soil explains the run"),
        "people are told all the same"
    );
}
