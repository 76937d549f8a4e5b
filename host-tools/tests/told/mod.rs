//! What a command says.

use std::process::Command;

use assert_cmd::assert::OutputAssertExt;

/// The standard output of a command that ends well.
pub fn told(command: &mut Command) -> String {
    String::from_utf8(command.assert().success().get_output().stdout.clone()).expect("text")
}
