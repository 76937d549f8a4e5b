//! Outputs that could not be written, or would replace what is read, and manoeuvres that cannot be, are refused before any work begins.

mod kapvik;
mod refused;
mod support;

use std::fs;

use kapvik::kapvik;
use refused::refused;
use support::{Made, TOML};

/// What a command says that is refused in a folder with a campaign, which stays as it was.
fn refusal(arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let csv = Made::default().csv();
    fs::write(folder.path().join("made.csv"), &csv).expect("written");
    fs::write(folder.path().join("made.toml"), TOML).expect("written");
    let output = refused(kapvik().current_dir(folder.path()).args(arguments), &[]);
    assert!(output.stdout.is_empty(), "{arguments:?} began");
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).expect("readable");
    assert!(read("made.csv") == csv && read("made.toml") == TOML, "{arguments:?}");
    String::from_utf8(output.stderr).expect("text")
}

#[test]
fn an_output_that_is_an_input_is_refused() {
    let cases: [&[&str]; 8] = [
        &["diagnose", "made.csv", "--declared", "made.toml"],
        &["diagnose", "made.csv", "--json", "./made.csv"],
        &["identify", "made.csv", "--method", "map", "--json", "made.csv"],
        &["close-loop", "made.csv", "--quick", "-o", ".", "--diagnosis", "declared.toml"],
        &["train", "--quick", "--declared", "made.toml", "-o", "made.toml"],
        &["run", "made.csv", "--on", "host", "--report", "made.toml"],
        &["observe", "--soil", "made.toml", "--json", "made.toml"],
        &["forward", "--wheel", "made.toml", "--soil", "made.toml", "made.csv", "-o", "made.toml"],
    ];
    for arguments in cases {
        let said = refusal(arguments);
        assert!(said.contains("the output is the input: expected another file"), "{arguments:?}: {said}");
    }
}

#[test]
fn no_folder_is_made_for_what_is_refused() {
    let said = refusal(&["close-loop", "made.csv", "--quick", "-o", "new", "--diagnosis", "nowhere.json"]);
    assert!(said.starts_with("kapvik: nowhere.json: No such file"), "{said}");
}

#[test]
fn outputs_that_are_one_file_are_refused() {
    for arguments in [
        ["diagnose", "made.csv", "--json", "same", "--html", "same"],
        ["train", "--quick", "-o", "same", "--picture", "./same"],
    ] {
        let said = refusal(&arguments);
        assert!(said.contains("two outputs go to this file"), "{said}");
    }
}

#[test]
fn manoeuvres_that_cannot_be_are_refused() {
    for (arguments, expected) in [
        (
            ["observe", "--speed", "0.05", "--top-speed", "0.02"],
            "--speed 0.05: expected no more than --top-speed, 0.02 m/s",
        ),
        (["observe", "--longest", "4.5", "--speed", "0.02"], "--longest 4.5: expected 5 s or more"),
    ] {
        let said = refusal(&arguments);
        assert!(said.contains(expected), "{said}");
    }
}

#[test]
fn a_folder_that_is_not_there_is_told_before_training() {
    let said = refusal(&["train", "-o", "nowhere/x.table"]);
    assert!(said.starts_with("kapvik: nowhere/x.table: No such file"), "{said}");
}

/// A table may have taken hours, and is not of this campaign.
#[test]
fn a_loop_without_a_finding_takes_no_table_away() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    fs::write(path("made.csv"), Made::default().csv()).expect("written");
    fs::write(path("made.toml"), TOML).expect("written");
    fs::write(path("kapvik.table"), "of another").expect("written");
    let output = kapvik().current_dir(&folder).args(["close-loop", "made.csv", "--quick", "-o", "."]).output();
    let output = output.expect("started");
    let said = String::from_utf8(output.stdout).expect("text");
    assert!(said.contains("Nothing was found") && said.contains("kapvik.table was there before"), "{said}");
    assert_eq!(fs::read_to_string(path("kapvik.table")).expect("readable"), "of another");
    assert!(path("declared.toml").exists());
}

#[test]
fn a_rover_has_no_place_beside_the_measured_states() {
    let output = kapvik().args(["run", "--measured", "--on", "host", "--rover", "r.toml"]).output().expect("started");
    assert_eq!(output.status.code(), Some(2), "{}", String::from_utf8_lossy(&output.stderr));
}
