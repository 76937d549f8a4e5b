//! Commands that are refused.

use std::collections::BTreeSet;
use std::fs;
use std::process::{Command, Output};

/// Fails in its folder with one line that has all of these words, and leaves no file there.
pub fn refused(command: &mut Command, words: &[&str]) -> Output {
    let folder = command.get_current_dir().expect("a folder to run in").to_owned();
    let files = || -> BTreeSet<_> {
        fs::read_dir(&folder).expect("readable").map(|entry| entry.expect("an entry").file_name()).collect()
    };
    let before = files();
    let output = command.output().expect("kapvik runs");
    let said = str::from_utf8(&output.stderr).expect("text");
    assert!(!output.status.success(), "{command:?} succeeded: {said}");
    assert_eq!(said.lines().count(), 1, "{command:?}: {said}");
    for word in words {
        assert!(said.contains(word), "{word} in {said}");
    }
    assert_eq!(files(), before, "{command:?} left something behind");
    output
}
